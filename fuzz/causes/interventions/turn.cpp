// Small rotations and moves of B: what vanishes was bound to an exact alignment.
#include <cmath>

#include "core/math/pose.h"
#include "fuzz/causes/intervention.h"

namespace touchstone::fuzz {
namespace {

// The body that is changed: B of the question, else the last one.
std::size_t second_body(const Case& c) {
  return asks_about_pair(c) ? static_cast<std::size_t>(c.queries[0].b) : c.scene.bodies.size() - 1;
}

template <class F>
void for_each_pose(Case& c, std::size_t body, F&& f) {
  f(c.scene.bodies[body].pose);
  for (Step& s : c.scene.script)
    if (s.pose && s.body == static_cast<int>(body)) f(*s.pose);
}

// About an axis through the body's origin that is no axis of symmetry of anything.
std::optional<Case> turned(const Case& c, double angle) {
  if (c.scene.bodies.empty()) return std::nullopt;
  const Vec3 axis = Vec3(3, -5, 7).normalized() * std::sin(angle / 2);
  const Quat turn{axis.x(), axis.y(), axis.z(), std::cos(angle / 2)};
  Case r = c;
  for_each_pose(r, second_body(c), [&](Pose& p) { p.rotation = normalized(turn * p.rotation); });
  return r;
}

}  // namespace

// Angles in radians: below the rounding of floats, near the tolerances that engines compare with, and
// visible.
constexpr double below_float = 1e-9, near_tolerances = 1e-6, visible = 1e-3;
std::optional<Case> turn_by_1e_9(const Case& c) { return turned(c, below_float); }
std::optional<Case> turn_by_1e_6(const Case& c) { return turned(c, near_tolerances); }
std::optional<Case> turn_by_1e_3(const Case& c) { return turned(c, visible); }

std::optional<Case> nudge(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  Case r = c;
  for_each_pose(r, second_body(c), [](Pose& p) {
    for (double& x : p.translation) x = std::nextafter(x, x < 0 ? -HUGE_VAL : HUGE_VAL);
  });
  return r;
}

std::optional<Case> set_upright(const Case& c) {
  Case r = c;
  bool any = false;
  const auto change = [&](Pose& p) {
    any |= p.rotation != Quat{};
    p.rotation = {};
  };
  for (Body& b : r.scene.bodies) change(b.pose);
  for (Step& s : r.scene.script)
    if (s.pose) change(*s.pose);
  if (!any) return std::nullopt;
  return r;
}

}  // namespace touchstone::fuzz
