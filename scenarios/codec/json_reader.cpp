#include "scenarios/codec/json_reader.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

namespace touchstone {

using Json = nlohmann::ordered_json;

void JsonReader::fail(const std::string& reason) const { throw InputError(place(), reason); }

std::string JsonReader::place() const { return json_place(file_, path_); }

void JsonReader::require_object() const {
  if (!j_->is_object()) fail(std::string("must be an object, is ") + j_->type_name());
}

void JsonReader::require_object(std::span<const std::string_view> known) const {
  require_object();
  for (const auto& [key, value] : j_->items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string list;
    for (std::string_view k : known) list += (list.empty() ? "" : ", ") + std::string(k);
    fail("unknown field " + Json(key).dump(-1, ' ', true, Json::error_handler_t::replace) + "; known are " +
         list);
  }
}

bool JsonReader::has(std::string_view field) const { return j_->is_object() && j_->contains(field); }

JsonReader JsonReader::operator[](std::string_view field) const {
  const auto it = j_->find(field);
  if (it == j_->end()) fail("field \"" + std::string(field) + "\" is missing");
  return JsonReader(*it, file_, path_.empty() ? std::string(field) : path_ + "." + std::string(field));
}

std::vector<JsonReader> JsonReader::items() const {
  require_array();
  std::vector<JsonReader> r;
  r.reserve(j_->size());
  for (std::size_t i = 0; i < j_->size(); ++i) r.push_back(item(i));
  return r;
}

std::vector<JsonReader> JsonReader::items(std::size_t exactly) const {
  if (j_->is_array() && j_->size() != exactly)
    fail("must have " + std::to_string(exactly) + " items, has " + std::to_string(j_->size()));
  return items();
}

double JsonReader::number() const {
  if (!j_->is_number()) fail(std::string("must be a number, is ") + j_->type_name());
  return j_->get<double>();
}

int JsonReader::integer() const {
  if (!j_->is_number_integer()) fail("must be a whole number");
  const bool fits = j_->is_number_unsigned() ? j_->get<std::uint64_t>() <=
                                                   static_cast<std::uint64_t>(std::numeric_limits<int>::max())
                                             : j_->get<std::int64_t>() >= std::numeric_limits<int>::min() &&
                                                   j_->get<std::int64_t>() <= std::numeric_limits<int>::max();
  if (!fits) fail("is out of range for an index");
  return j_->get<int>();
}

bool JsonReader::boolean() const {
  if (!j_->is_boolean()) fail(std::string("must be true or false, is ") + j_->type_name());
  return j_->get<bool>();
}

std::string JsonReader::string() const {
  if (!j_->is_string()) fail(std::string("must be a string, is ") + j_->type_name());
  return printable(j_->get_ref<const std::string&>(), "\n\t");
}

namespace {

// Fast path for large meshes. Whatever it rejects is read again by the slow path, which reports the place.
std::optional<Vec3> plain_vec3(const Json& j) {
  if (!j.is_array() || j.size() != 3 || !j[0].is_number() || !j[1].is_number() || !j[2].is_number())
    return std::nullopt;
  return Vec3(j[0].get<double>(), j[1].get<double>(), j[2].get<double>());
}

std::optional<std::array<int, 3>> plain_triple(const Json& j) {
  if (!j.is_array() || j.size() != 3) return std::nullopt;
  std::array<int, 3> t{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!j[i].is_number_unsigned() || j[i].get<std::uint64_t>() > std::numeric_limits<int>::max())
      return std::nullopt;
    t[i] = j[i].get<int>();
  }
  return t;
}

}  // namespace

JsonReader JsonReader::item(std::size_t i) const {
  return JsonReader((*j_)[i], file_, path_ + "[" + std::to_string(i) + "]");
}

void JsonReader::require_array() const {
  if (!j_->is_array()) fail(std::string("must be an array, is ") + j_->type_name());
}

Vec3 JsonReader::vec3() const {
  if (const auto plain = plain_vec3(*j_)) return *plain;
  const auto v = items(3);
  return {v[0].number(), v[1].number(), v[2].number()};
}

std::vector<Vec3> JsonReader::points() const {
  require_array();
  std::vector<Vec3> r;
  r.reserve(j_->size());
  for (std::size_t i = 0; i < j_->size(); ++i) {
    const auto plain = plain_vec3((*j_)[i]);
    r.push_back(plain ? *plain : item(i).vec3());
  }
  return r;
}

std::array<int, 3> JsonReader::triple() const {
  if (const auto plain = plain_triple(*j_)) return *plain;
  const auto v = items(3);
  return {v[0].integer(), v[1].integer(), v[2].integer()};
}

std::vector<std::array<int, 3>> JsonReader::triples() const {
  require_array();
  std::vector<std::array<int, 3>> r;
  r.reserve(j_->size());
  for (std::size_t i = 0; i < j_->size(); ++i) {
    const auto plain = plain_triple((*j_)[i]);
    r.push_back(plain ? *plain : item(i).triple());
  }
  return r;
}

}  // namespace touchstone
