// JSON of a text. Compiled once, because nlohmann's parser takes a second in each file that uses it.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace touchstone::test {

/// Throws nlohmann::json::parse_error.
template <class Json>
Json parsed(std::string_view text);
template <>
nlohmann::json parsed(std::string_view text);
template <>
nlohmann::ordered_json parsed(std::string_view text);

}  // namespace touchstone::test
