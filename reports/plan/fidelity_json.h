// A plan as JSON, so that it can be run again.
#pragma once

#include "core/world/fidelity.h"
#include "reports/record/observation_json.h"

namespace touchstone::fuzz {

/// "double", "double alone", "float".
std::string_view to_string(Arithmetic a);
Json to_json(const Fidelity& f);
/// Throws InputError with the JSON path, prefixed by `place`.
Fidelity fidelity_from_json(const Json& j, const std::string& place);

}  // namespace touchstone::fuzz
