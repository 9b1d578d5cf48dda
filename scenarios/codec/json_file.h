// JSON from outside and to outside. Every file of JSON that a command reads comes in through parse_json, so
// that all have one set of limits: depth (json_text.h), bytes, values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenarios/codec/json_reader.h"
#include "scenarios/codec/json_text.h"

namespace touchstone {

/// How much a document may hold. A value takes up to 100 bytes of memory, however few the text has for it.
struct JsonLimits {
  std::uintmax_t bytes = std::uintmax_t{256} << 20;
  std::size_t values = 12'000'000;
};
/// The state of a campaign holds a case and a certificate for every kind of finding.
inline constexpr JsonLimits campaign_limits{std::uintmax_t{4} << 30, 40'000'000};

/// A file whole. Throws InputError, place and reason.
nlohmann::ordered_json load_json(const std::filesystem::path& file, const JsonLimits& limits = {});
nlohmann::ordered_json parse_json(std::string_view text, const std::string& place, const JsonLimits& limits);

/// Writes anything: what is not UTF-8 in a string becomes U+FFFD, so that one engine's last words cannot keep
/// the others' results from being written. indent -1: one line.
std::string json_text(const nlohmann::ordered_json& j, int indent = -1);

/// What the library's exception says, without its number.
std::string reason_of(const nlohmann::ordered_json::exception& e);

/// A whole number, 0 or more.
std::uint64_t count_of(const JsonReader& r);
/// The members of an object, in their order.
std::vector<std::pair<std::string, JsonReader>> members_of(const JsonReader& r);

}  // namespace touchstone
