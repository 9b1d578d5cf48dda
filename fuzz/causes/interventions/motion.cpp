// How the bodies move.
#include <algorithm>

#include "fuzz/causes/intervention.h"
#include "fuzz/causes/interventions/true_pair.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {

std::optional<Case> stop_turning(const Case& c) {
  Case r = c;
  bool any = false;
  for (Body& b : r.scene.bodies)
    if (b.motion && !b.motion->angular.isZero(0)) {
      b.motion->angular.setZero();
      any = true;
    }
  if (!any) return std::nullopt;
  return r;
}

namespace {

// Of two bodies: candidates of moving bodies name none.
bool is_about_impact(const Case& c) {
  return asks_about_pair(c) && is_motion_question(c.queries[0].question);
}

}  // namespace

std::optional<Case> move_b_only(const Case& c) {
  if (!is_about_impact(c)) return std::nullopt;
  Case r = c;
  Body& a = r.scene.bodies[static_cast<std::size_t>(c.queries[0].a)];
  Body& b = r.scene.bodies[static_cast<std::size_t>(c.queries[0].b)];
  if (!a.motion || !a.motion->angular.isZero(0) || a.motion->linear.isZero(0)) return std::nullopt;
  if (!is_convex(kind_of(r.scene.shape_of(c.queries[0].b)))) return std::nullopt;
  if (!b.motion) b.motion = Motion{};
  b.motion->linear -= a.motion->linear;
  a.motion.reset();
  return r;
}

namespace {

Vec3 velocity(const Case& c, int body) {
  const auto& motion = c.scene.bodies[static_cast<std::size_t>(body)].motion;
  return motion ? motion->linear : Vec3::Zero();
}
Vec3 relative_velocity(const Case& c) { return velocity(c, c.queries[0].b) - velocity(c, c.queries[0].a); }

// Linear velocities times `faster`, and B moved along the relative velocity so that the bodies meet at
// `time`; exactly so if none of them turns.
std::optional<Case> meeting_at(const Case& c, double time, double faster) {
  if (!is_about_impact(c)) return std::nullopt;
  Truth truth(c.scene);
  const referee::TimeTruth& impact = truth.motion(0, c.queries[0].a, c.queries[0].b);
  const Vec3 v = relative_velocity(c);
  if (impact.verdict != referee::TimeTruth::Verdict::hit || v.isZero(0)) return std::nullopt;
  Case r = c;
  for (Body& b : r.scene.bodies)
    if (b.motion) b.motion->linear *= faster;
  const double before = (impact.t_lo + impact.t_hi) / 2;
  r.scene.bodies[static_cast<std::size_t>(c.queries[0].b)].pose.translation +=
      v * before - v * (faster * time);
  return r;
}

std::optional<Case> with_turning(const Case& c, void (*change)(Vec3&)) {
  if (!is_about_impact(c)) return std::nullopt;
  Case r = c;
  bool any = false;
  for (Body& b : r.scene.bodies)
    if (b.motion && !b.motion->angular.isZero(0)) {
      change(b.motion->angular);
      any = true;
    }
  if (!any) return std::nullopt;
  return r;
}

std::optional<Case> without_turning(const Case& c, bool second) {
  if (!is_about_impact(c)) return std::nullopt;
  Case r = c;
  auto& motion = r.scene.bodies[static_cast<std::size_t>(second ? c.queries[0].b : c.queries[0].a)].motion;
  if (!motion || motion->angular.isZero(0)) return std::nullopt;
  motion->angular.setZero();
  return r;
}

// B turns about an axis through its origin, by a third of a radian during the step.
std::optional<Case> with_body_turning(const Case& c, bool second) {
  if (!is_about_impact(c)) return std::nullopt;
  const int of = second ? c.queries[0].b : c.queries[0].a;
  if (!is_convex(kind_of(c.scene.shape_of(of)))) return std::nullopt;
  Case r = c;
  auto& motion = r.scene.bodies[static_cast<std::size_t>(of)].motion;
  if (motion && !motion->angular.isZero(0)) return std::nullopt;
  if (!motion) motion = Motion{};
  motion->angular = Vec3(0.125, 0.125, 0.25);
  return r;
}

}  // namespace

std::optional<Case> meet_early(const Case& c) { return meeting_at(c, 1.0 / 16, 1); }
std::optional<Case> meet_half_way(const Case& c) { return meeting_at(c, 0.5, 1); }
std::optional<Case> meet_late(const Case& c) { return meeting_at(c, 15.0 / 16, 1); }
std::optional<Case> meet_head_on(const Case& c) {
  if (!is_about_impact(c)) return std::nullopt;
  const auto p = true_pair(c);
  if (!p) return std::nullopt;
  Case r = moved_along(c, *p, p->size / 2 - p->gap);
  for (Body& b : r.scene.bodies) b.motion.reset();
  const bool b_moves = is_convex(kind_of(c.scene.shape_of(p->b)));
  if (!b_moves && !is_convex(kind_of(c.scene.shape_of(p->a)))) return std::nullopt;
  r.scene.bodies[static_cast<std::size_t>(b_moves ? p->b : p->a)].motion =
      Motion{p->normal * (b_moves ? -p->size : p->size), Vec3::Zero()};
  return r;
}
std::optional<Case> move_faster(const Case& c) { return meeting_at(c, 0.5, 64); }
std::optional<Case> move_slower(const Case& c) { return meeting_at(c, 0.5, 1.0 / 64); }
std::optional<Case> turn_faster(const Case& c) {
  return with_turning(c, [](Vec3& w) { w *= 4; });
}
std::optional<Case> turn_slower(const Case& c) {
  return with_turning(c, [](Vec3& w) { w /= 4; });
}
std::optional<Case> turn_back(const Case& c) {
  return with_turning(c, [](Vec3& w) { w = -w; });
}
std::optional<Case> stop_turning_a(const Case& c) { return without_turning(c, false); }
std::optional<Case> stop_turning_b(const Case& c) { return without_turning(c, true); }
std::optional<Case> let_a_turn(const Case& c) { return with_body_turning(c, false); }
std::optional<Case> let_b_turn(const Case& c) { return with_body_turning(c, true); }

namespace {

bool is_about_sweep(const Case& c) {
  return !c.queries.empty() && c.queries[0].question == Question::swept_candidates;
}

}  // namespace

std::optional<Case> travel_twice_as_far(const Case& c) {
  if (!is_about_sweep(c)) return std::nullopt;
  Case r = c;
  for (Body& b : r.scene.bodies)
    if (b.motion) b.motion->linear *= 2;
  return r;
}

std::optional<Case> as_turning_bar(const Case& c) {
  if (!is_about_sweep(c)) return std::nullopt;
  Case r = c;
  r.scene.shapes = {Box{Vec3::Ones()}, Box{Vec3(4, 0.25, 0.25)}};
  r.scene.bodies = {Body{}, Body{}};
  r.queries.resize(1);
  r.scene.script.clear();
  r.scene.ignored.clear();
  Body& bar = r.scene.bodies[1];
  bar.shape = 1;
  bar.pose.translation.y() = 3;
  bar.motion = Motion{Vec3::Zero(), Vec3(0, 0, 1.5)};  // by nearly a quarter turn
  return r;
}

std::optional<Case> release_static(const Case& c) {
  Case r = c;
  bool any = false;
  for (Body& b : r.scene.bodies)
    if (b.is_static && is_convex(kind_of(r.scene.shapes[static_cast<std::size_t>(b.shape)]))) {
      b.is_static = false;
      any = true;
    }
  if (!any) return std::nullopt;
  return r;
}

}  // namespace touchstone::fuzz
