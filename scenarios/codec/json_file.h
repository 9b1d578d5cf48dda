// JSON input and output. Every JSON file that a command reads goes through parse_json, so that the same
// limits apply to all: depth (json_text.h), bytes, values.
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

/// Limits on a document. A value takes up to 100 bytes of memory, however short its text is.
struct JsonLimits {
  std::uintmax_t bytes = std::uintmax_t{256} << 20;
  std::size_t values = 12'000'000;
};
/// The state of a campaign has a case and a certificate for every kind of finding.
inline constexpr JsonLimits campaign_limits{std::uintmax_t{4} << 30, 40'000'000};

/// Reads a whole file. Throws InputError with place and reason.
nlohmann::ordered_json load_json(const std::filesystem::path& file, const JsonLimits& limits = {});
nlohmann::ordered_json parse_json(std::string_view text, const std::string& place, const JsonLimits& limits);

/// Never fails: invalid UTF-8 in a string becomes U+FFFD, so that one engine's last output cannot prevent the
/// others' results from being written. indent -1: one line.
std::string json_text(const nlohmann::ordered_json& j, int indent = -1);

/// The message of the library's exception without its number.
std::string reason_of(const nlohmann::ordered_json::exception& e);

/// A whole number, 0 or more.
std::uint64_t count_of(const JsonReader& r);
/// The members of an object, in order.
std::vector<std::pair<std::string, JsonReader>> members_of(const JsonReader& r);

}  // namespace touchstone
