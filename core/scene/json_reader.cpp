#include "core/scene/json_reader.h"

#include <algorithm>
#include <limits>

#include "core/base/input_error.h"
#include "core/scene/json_text.h"

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
  if (!j_->is_array()) fail(std::string("must be an array, is ") + j_->type_name());
  std::vector<JsonReader> r;
  r.reserve(j_->size());
  for (std::size_t i = 0; i < j_->size(); ++i)
    r.emplace_back((*j_)[i], file_, path_ + "[" + std::to_string(i) + "]");
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
  return j_->get<std::string>();
}

Vec3 JsonReader::vec3() const {
  const auto v = items(3);
  return {v[0].number(), v[1].number(), v[2].number()};
}

std::vector<Vec3> JsonReader::points() const {
  std::vector<Vec3> r;
  for (const JsonReader& p : items()) r.push_back(p.vec3());
  return r;
}

std::vector<std::array<int, 3>> JsonReader::triples() const {
  std::vector<std::array<int, 3>> r;
  for (const JsonReader& t : items()) {
    const auto v = t.items(3);
    r.push_back({v[0].integer(), v[1].integer(), v[2].integer()});
  }
  return r;
}

}  // namespace touchstone
