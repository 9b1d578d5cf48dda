// JSON as text, stricter and more exact than the library underneath (nlohmann/json): "-0" keeps its sign,
// duplicate keys and deep nesting are refused, syntax errors have line and column, and doubles are written in
// the shortest form that reads back to the same bits.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace touchstone {

/// Our formats nest seven levels; a finding with a certificate, about ten.
inline constexpr int max_json_depth = 64;

/// Throws InputError, place = `place` + ":line:column" (column in bytes, from 1).
nlohmann::ordered_json parse_json(std::string_view text, const std::string& place = "");

/// One line without a newline. Throws InputError on a number that JSON cannot represent (NaN, infinity).
std::string to_line(const nlohmann::ordered_json& j);

/// `prefix` is the file; joins file and JSON path as "file: path".
std::string json_place(const std::string& prefix, const std::string& path);

}  // namespace touchstone
