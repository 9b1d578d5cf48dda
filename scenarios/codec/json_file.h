// Reading and writing of files, and JSON text. Every JSON file that a command reads goes through parse_json,
// so that the same limits apply to all: depth, bytes, values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenarios/codec/json_reader.h"
#include "scenarios/codec/scene_codec.h"

namespace touchstone {

/// Throws InputError with the file's name when it does not exist or is not a regular file: reading a pipe, a
/// socket or a device may block forever. Use it before libraries that open files themselves; read_file calls
/// it.
void require_regular_file(const std::filesystem::path& file);

/// Writes to FILE.part, then renames it, so that the old contents stay until everything is written. Devices
/// and pipes are written directly. Throws InputError with the system's reason.
void write_file(const std::filesystem::path& file, std::string_view text);

/// Our formats nest seven levels; a finding with a certificate, about ten.
inline constexpr int max_json_depth = 64;

/// Throws InputError, place = `place` + ":line:column" (column in bytes, from 1).
nlohmann::ordered_json parse_json(std::string_view text, const std::string& place = "");

/// One line without a newline. Throws InputError on a number that JSON cannot represent (NaN, infinity).
std::string to_line(const nlohmann::ordered_json& j);

/// `prefix` is the file; joins file and JSON path as "file: path".
std::string json_place(const std::string& prefix, const std::string& path);

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
