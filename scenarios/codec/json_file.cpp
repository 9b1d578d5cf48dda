#include "scenarios/codec/json_file.h"

#include "scenarios/codec/scene_codec.h"

namespace touchstone {

nlohmann::ordered_json load_json(const std::filesystem::path& file, const JsonLimits& limits) {
  return parse_json(read_file(file, limits.bytes), file.string(), limits);
}

std::string json_text(const nlohmann::ordered_json& j, int indent) {
  return j.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string reason_of(const nlohmann::ordered_json::exception& e) {
  std::string s = e.what();
  if (const auto bracket = s.find("] "); bracket != std::string::npos) s.erase(0, bracket + 2);
  return s;
}

std::uint64_t count_of(const JsonReader& r) {
  const auto& j = r.json();
  const bool whole = j.is_number_unsigned() || (j.is_number_integer() && j.get<std::int64_t>() >= 0);
  if (!whole) r.fail("must be a whole number, 0 or more");
  return j.get<std::uint64_t>();
}

std::vector<std::pair<std::string, JsonReader>> members_of(const JsonReader& r) {
  r.require_object();
  std::vector<std::pair<std::string, JsonReader>> members;
  members.reserve(r.json().size());
  const std::string place = r.place(), before = place.empty() ? "" : place + (place == r.file() ? ": " : ".");
  for (const auto& [key, value] : r.json().items())
    members.emplace_back(key, JsonReader(value, before + key));
  return members;
}

}  // namespace touchstone
