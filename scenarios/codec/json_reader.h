// Reads typed values from JSON and reports the place of errors: "scene.json: bodies[3].pose.rotation".
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/pose.h"

namespace touchstone {

class JsonReader {
 public:
  JsonReader(const nlohmann::ordered_json& j, std::string file, std::string path = "")
      : j_(&j), file_(std::move(file)), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& reason) const;
  const nlohmann::ordered_json& json() const { return *j_; }
  const std::string& file() const { return file_; }
  std::string place() const;

  /// An object whose fields are all among `known`.
  void require_object(std::span<const std::string_view> known) const;
  /// An object, whatever its fields.
  void require_object() const;
  bool has(std::string_view field) const;
  /// The member of that name; fails when it is missing.
  JsonReader operator[](std::string_view field) const;
  std::vector<JsonReader> items() const;  // of an array
  std::vector<JsonReader> items(std::size_t exactly) const;

  double number() const;  // finite by construction of JSON; integers are rounded to the nearest double
  int integer() const;    // a whole number that fits an int
  bool boolean() const;
  std::string string() const;
  Vec3 vec3() const;
  std::array<int, 3> triple() const;
  std::vector<Vec3> points() const;
  std::vector<std::array<int, 3>> triples() const;

 private:
  void require_array() const;
  JsonReader item(std::size_t i) const;

  const nlohmann::ordered_json* j_;
  std::string file_, path_;
};

}  // namespace touchstone
