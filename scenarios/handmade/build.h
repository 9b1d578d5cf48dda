// Helpers for writing scenarios.
#pragma once

#include "scenarios/handmade/scenario.h"

namespace touchstone::scenarios {

struct Part {
  Shape shape;
  Pose pose;
  std::optional<Motion> motion;
};

inline Pose at(double x, double y, double z) { return {Vec3(x, y, z), Quat{}}; }
inline Pose at(double x, double y, double z, const Quat& q) { return {Vec3(x, y, z), q}; }

inline Motion moving(double x, double y, double z) { return {Vec3(x, y, z), Vec3::Zero()}; }

/// Quarter and half turns that are exact: R(q) divides by |q|², so these matrices are permutations.
inline constexpr Quat quarter_turn_x{1, 0, 0, 1}, quarter_turn_y{0, 1, 0, 1}, quarter_turn_z{0, 0, 1, 1};
inline constexpr Quat half_turn_x{1, 0, 0, 0};

/// The error of n roundings of doubles of magnitude l.
inline double roundings(double n, double l) { return n * 0x1p-53 * l; }

/// Meshes and half-spaces become static bodies.
Scene scene_of(const std::string& name, std::vector<Part> parts);
/// Uses default_queries.
Scenario scenario(std::string folder, std::string name, std::string line, Scene scene, Expectation expect);
Scenario pair(std::string folder, std::string name, std::string line, Part a, Part b, Expectation expect);

/// For a whole scene: all pairs, pairs whose boxes meet (empty: unspecified), pairs that overlap.
Expectation counts(int all, std::optional<int> boxes, int overlapping, std::string reason);
Expectation gap_is(double value, double tolerance, const Vec3& normal, std::string reason);
Expectation hit_at(double time, double tolerance, std::string reason);
Expectation no_hit(std::string reason);

}  // namespace touchstone::scenarios
