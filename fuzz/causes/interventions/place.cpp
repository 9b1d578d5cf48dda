// The same scene in another unit, or elsewhere.
#include <algorithm>
#include <cmath>

#include "fuzz/causes/intervention.h"
#include "fuzz/judge/exact_map.h"

namespace touchstone::fuzz {
namespace {

constexpr double factor = 1024;

void scale_script(Scene& s, double by) {
  for (Step& step : s.script)
    if (step.pose) step.pose->translation *= by;
}

std::optional<Case> scaled(const Case& c, double by) {
  Case r = c;
  if (!scale_by(r.scene, by)) return std::nullopt;
  scale_script(r.scene, by);
  return r;
}

// Rounds where the sums are not exact.
std::optional<Case> moved(const Case& c, const Vec3& by) {
  if (by.isZero(0)) return std::nullopt;
  Case r = c;
  translate_by(r.scene, by);
  for (Step& step : r.scene.script)
    if (step.pose) step.pose->translation += by;
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

std::optional<Case> scale_up(const Case& c) { return scaled(c, factor); }
std::optional<Case> scale_down(const Case& c) { return scaled(c, 1 / factor); }

std::optional<Case> move_to_origin(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  return moved(c, -first_position(c));
}

std::optional<Case> move_away(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  const double length = largest_length(c.scene);
  return moved(c, Vec3(16, -32, 64) * length);
}

std::optional<Case> turn_world(const Case& c) {
  constexpr Quat quarter{1, 0, 0, 1};
  Mat3 m;
  m << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  Case r = c;
  const auto turn = [&](Pose& p) {
    p.translation = m * p.translation;
    p.rotation = normalized(quarter * p.rotation);
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

}  // namespace touchstone::fuzz
