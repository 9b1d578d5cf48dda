// The part of JSON Schema (draft 2020-12) that scene.schema.json uses. An unknown keyword is an error, so
// that the schema cannot rely on something that is silently not checked.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace touchstone::test {

using Json = nlohmann::ordered_json;

/// Empty if `value` conforms to `schema` (references resolve in `root`), else the fault with its path.
std::string schema_violation(const Json& root, const Json& schema, const Json& value,
                             const std::string& path = "$");

}  // namespace touchstone::test
