// The public collection of known failures (known-failures.json beside the shared data): its entries as
// values.
#pragma once

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "core/scene/scene.h"
#include "tests/support/shared_data.h"

namespace touchstone::test {

inline std::filesystem::path known_failures_file() { return shared_data() / "../known-failures.json"; }

inline Vec3 vector_of(const nlohmann::json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

/// A triangle is a hull of three vertices. Hulls have no faces yet. Throws std::runtime_error for another
/// type.
inline Shape shape_of(const nlohmann::json& j) {
  const std::string type = j.at("type");
  const auto number = [&](const char* name) { return j.at(name).get<double>(); };
  if (type == "sphere") return Sphere{number("radius")};
  if (type == "box") return Box{vector_of(j.at("half_extents"))};
  if (type == "capsule") return Capsule{number("radius"), number("half_height")};
  if (type == "cylinder") return Cylinder{number("radius"), number("half_height")};
  if (type == "cone") return Cone{number("radius"), number("half_height")};
  if (type != "convex" && type != "triangle") throw std::runtime_error("unknown shape: " + type);
  Hull h;
  for (const nlohmann::json& v : j.at("vertices")) h.vertices.push_back(vector_of(v));
  return h;
}

inline Quat quaternion_of(const nlohmann::json& pose) {
  const nlohmann::json& q = pose.at("quaternion");
  return {q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(), q.at(3).get<double>()};
}

/// Constant velocities that lead from one pose to the other by the shortest arc.
inline Motion motion_between(const nlohmann::json& from, const nlohmann::json& to) {
  constexpr double least_turn = 1e-15;  // below: rounding of equal quaternions
  Motion m;
  m.linear = vector_of(to.at("translation")) - vector_of(from.at("translation"));
  const Quat p = normalized(quaternion_of(from)), q = normalized(quaternion_of(to));
  Quat d = q * Quat{-p.x, -p.y, -p.z, p.w};
  if (d.w < 0) d = {-d.x, -d.y, -d.z, -d.w};
  const Vec3 axis(d.x, d.y, d.z);
  if (axis.norm() > least_turn) m.angular = 2 * std::atan2(axis.norm(), d.w) * axis.normalized();
  return m;
}

/// False for entries that describe a family without numbers of its own.
inline bool has_shapes(const nlohmann::json& entry) {
  return entry.contains("shape_a") && !entry.at("shape_a").is_null();
}

}  // namespace touchstone::test
