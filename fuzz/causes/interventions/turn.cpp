// Small rotations and moves of B: what vanishes was bound to an exact alignment.
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "core/math/pose.h"
#include "fuzz/causes/intervention.h"
#include "fuzz/causes/interventions/true_pair.h"

namespace touchstone::fuzz {
namespace {

// The bodies that are changed: those of the question, else the first and the last one.
std::size_t first_body(const Case& c) {
  return asks_about_pair(c) ? static_cast<std::size_t>(c.queries[0].a) : 0;
}
std::size_t second_body(const Case& c) {
  return asks_about_pair(c) ? static_cast<std::size_t>(c.queries[0].b) : c.scene.bodies.size() - 1;
}

template <class F>
void for_each_pose(Case& c, std::size_t body, F&& f) {
  f(c.scene.bodies[body].pose);
  for (Step& s : c.scene.script)
    if (s.pose && s.body == static_cast<int>(body)) f(*s.pose);
}

// About an axis through the body's origin that is no axis of symmetry of anything. A quaternion that is not
// unit keeps its length, so that a fault which its length causes does not vanish.
std::optional<Case> turned(const Case& c, double angle, bool second = true) {
  if (c.scene.bodies.empty()) return std::nullopt;
  const Vec3 axis = Vec3(3, -5, 7).normalized() * std::sin(angle / 2);
  const Quat turn{axis.x(), axis.y(), axis.z(), std::cos(angle / 2)};
  Case r = c;
  for_each_pose(r, second ? second_body(c) : first_body(c),
                [&](Pose& p) { p.rotation = turn * p.rotation; });
  return r;
}

}  // namespace

// Angles in radians: below the rounding of floats, near the tolerances that engines compare with, and
// visible.
constexpr double below_float = 1e-9, near_tolerances = 1e-6, visible = 1e-3, half_a_radian = 0.5;
std::optional<Case> turn_by_1e_9(const Case& c) { return turned(c, below_float); }
std::optional<Case> turn_by_1e_6(const Case& c) { return turned(c, near_tolerances); }
std::optional<Case> turn_by_1e_3(const Case& c) { return turned(c, visible); }

std::optional<Case> turn_a(const Case& c) { return turned(c, half_a_radian, false); }
std::optional<Case> turn_b(const Case& c) { return turned(c, half_a_radian); }

std::optional<Case> nudge(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  Case r = c;
  for_each_pose(r, second_body(c), [](Pose& p) {
    for (double& x : p.translation) x = std::nextafter(x, x < 0 ? -HUGE_VAL : HUGE_VAL);
  });
  return r;
}

namespace {

std::optional<Case> upright(const Case& c, std::span<const std::size_t> bodies) {
  Case r = c;
  bool any = false;
  for (const std::size_t body : bodies)
    for_each_pose(r, body, [&](Pose& p) {
      any |= p.rotation != Quat{};
      p.rotation = {};
    });
  if (!any) return std::nullopt;
  return r;
}

}  // namespace

std::optional<Case> set_upright(const Case& c) {
  std::vector<std::size_t> all(c.scene.bodies.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return upright(c, all);
}
std::optional<Case> set_a_upright(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  return upright(c, std::array{first_body(c)});
}
std::optional<Case> set_b_upright(const Case& c) {
  if (c.scene.bodies.empty()) return std::nullopt;
  return upright(c, std::array{second_body(c)});
}

namespace {

// The body turned so that one of its own axes is along the normal; the gap stays as it is.
std::optional<Case> aligned(const Case& c, bool second) {
  const auto p = true_pair(c);
  if (!p) return std::nullopt;
  const auto turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), p->normal);
  Case r = c;
  for_each_pose(r, static_cast<std::size_t>(second ? p->b : p->a), [&](Pose& pose) {
    pose.rotation = normalized({turn.x(), turn.y(), turn.z(), turn.w()});
  });
  return with_gap(r, p->gap);
}

}  // namespace

std::optional<Case> align_a(const Case& c) { return aligned(c, false); }
std::optional<Case> align_b(const Case& c) { return aligned(c, true); }

std::optional<Case> align_world(const Case& c) {
  const auto p = true_pair(c);
  if (!p) return std::nullopt;
  const auto turn = Eigen::Quaterniond::FromTwoVectors(p->normal, Vec3::UnitX());
  const Quat q = normalized({turn.x(), turn.y(), turn.z(), turn.w()});
  const Mat3 m = turn.toRotationMatrix();
  Case r = c;
  for (std::size_t i = 0; i < r.scene.bodies.size(); ++i)
    for_each_pose(r, i, [&](Pose& pose) {
      pose.translation = m * pose.translation;
      pose.rotation = q * pose.rotation;
    });
  for (Body& b : r.scene.bodies)
    if (b.motion) b.motion = Motion{m * b.motion->linear, m * b.motion->angular};
  return r;
}

std::optional<Case> press_by_rounding(const Case& c) {
  const auto p = true_pair(c);
  if (!p) return std::nullopt;
  Case r = c;
  for_each_pose(r, static_cast<std::size_t>(p->b), [&](Pose& pose) {
    for (int k = 0; k < 3; ++k)
      if (p->normal[k] != 0)
        pose.translation[k] = std::nextafter(pose.translation[k], p->normal[k] > 0 ? -HUGE_VAL : HUGE_VAL);
  });
  return r;
}

}  // namespace touchstone::fuzz
