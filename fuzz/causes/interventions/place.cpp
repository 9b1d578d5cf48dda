// The same scene in another unit, or elsewhere.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fuzz/causes/intervention.h"
#include "fuzz/judge/exact_map.h"

namespace touchstone::fuzz {
namespace {

constexpr double very_far = 0x1p20;  // in sizes: doubles keep 32 bits of the size, floats few

std::optional<Case> scaled(const Case& c, double by) {
  Case r = c;
  if (!scale_by(r.scene, by)) return std::nullopt;
  return r;
}

// Rounds where the sums are not exact.
std::optional<Case> moved(const Case& c, const Vec3& by) {
  if (by.isZero(0)) return std::nullopt;
  Case r = c;
  translate_by(r.scene, by);
  return r;
}

// A power of two near the largest extent of a shape.
double largest_length(const Scene& s) {
  double length = 0;
  for (const Shape& shape : s.shapes) length = std::max(length, extent(shape));
  return length > 0 && std::isfinite(length) ? std::ldexp(1.0, std::ilogb(length)) : 1;
}

const Vec3& first_position(const Case& c) {
  const int a = asks_about_pair(c) ? c.queries[0].a : 0;
  return c.scene.bodies[static_cast<std::size_t>(a)].pose.translation;
}

}  // namespace

std::optional<Case> scale_up(const Case& c) { return scaled(c, large_factor); }
std::optional<Case> scale_down(const Case& c) { return scaled(c, 1 / large_factor); }
std::optional<Case> scale_up_little(const Case& c) { return scaled(c, small_factor); }
std::optional<Case> scale_down_little(const Case& c) { return scaled(c, 1 / small_factor); }

std::optional<Case> move_to_origin(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  return moved(c, -first_position(c));
}

std::optional<Case> move_away(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  const double length = largest_length(c.scene);
  return moved(c, Vec3(16, -32, 64) * length);
}

std::optional<Case> move_far(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  return moved(c, Vec3(1, 1, 1) * (largest_length(c.scene) * very_far));
}

std::optional<Case> move_to_negative(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  return moved(c, Vec3(-16, -32, -64) * largest_length(c.scene));
}

namespace {

// A quarter turn about one axis of the world, which rounds. The lengths of quaternions stay what they are.
Case quarter_turn(const Case& c, int axis) {
  constexpr double half_angle = std::numbers::pi / 4;
  const Vec3 about = Vec3::Unit(axis) * std::sin(half_angle);
  const Quat quarter{about.x(), about.y(), about.z(), std::cos(half_angle)};
  const int next = (axis + 1) % 3, after = (axis + 2) % 3;
  Mat3 m = Mat3::Zero();
  m(axis, axis) = 1;
  m(next, after) = -1;
  m(after, next) = 1;
  Case r = c;
  const auto turn = [&](Pose& p) {
    p.translation = m * p.translation;
    p.rotation = quarter * p.rotation;
  };
  for (Body& b : r.scene.bodies) {
    turn(b.pose);
    if (!b.motion) continue;
    b.motion->linear = m * b.motion->linear;
    b.motion->angular = m * b.motion->angular;
  }
  for (Step& s : r.scene.script)
    if (s.pose) turn(*s.pose);
  return r;
}

std::optional<Case> half_turned(const Case& c, int axis) {
  Case r = c;
  half_turn(r.scene, axis);
  return r;
}

}  // namespace

std::optional<Case> turn_world(const Case& c) { return quarter_turn(c, 0); }
std::optional<Case> turn_world_y(const Case& c) { return quarter_turn(c, 1); }
std::optional<Case> turn_world_z(const Case& c) { return quarter_turn(c, 2); }
std::optional<Case> half_turn_world(const Case& c) { return half_turned(c, 0); }
std::optional<Case> half_turn_world_z(const Case& c) { return half_turned(c, 2); }

}  // namespace touchstone::fuzz
