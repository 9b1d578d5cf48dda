#include "core/impact/alternatives.h"

#include "core/narrow/narrow_phase.h"

namespace touchstone {
namespace {

PlacedShape placed_at(const MovingShape& s, double t) {
  PlacedShape r = s;
  r.pose = pose_at(s.pose, s.motion, t);
  return r;
}

double reach_of_turning(const MovingShape& s) {
  return s.motion.angular.isZero(0) ? 0 : s.bounding_radius() * s.motion.angular.norm();
}

Vec3 velocity_at(const MovingShape& s, const Vec3& point_w) {
  return s.motion.linear + s.motion.angular.cross(point_w - s.pose.translation);
}

ImpactAnswer first_overlap(const MovingShape& a, const MovingShape& b, int first, int substeps) {
  ImpactAnswer r;
  for (int k = first; k <= substeps; ++k) {
    const double t = static_cast<double>(k) / substeps;
    const OverlapAnswer o = overlap(placed_at(a, t), placed_at(b, t));
    r.outcome = o.outcome;
    ++r.steps;
    if (o.outcome != Outcome::answered) return r;
    if (!o.overlap) continue;
    r.toi = t;
    return r;
  }
  return r;
}

}  // namespace

ImpactAnswer end_pose_impact(const MovingShape& a, const MovingShape& b) { return first_overlap(a, b, 1, 1); }

ImpactAnswer substep_impact(const MovingShape& a, const MovingShape& b, int substeps) {
  if (substeps < 1) {
    ImpactAnswer r;
    r.outcome = Outcome::invalid_input;
    return r;
  }
  return first_overlap(a, b, 0, substeps);
}

ImpactAnswer speculative_impact(const MovingShape& a, const MovingShape& b, double margin) {
  ImpactAnswer r;
  const DistanceAnswer d = distance(placed_at(a, 0), placed_at(b, 0));
  r.outcome = d.outcome;
  r.separation = d.distance;
  r.steps = 1;
  if (d.outcome != Outcome::answered) return r;
  if (d.distance <= 0) {
    r.toi = 0;
    return r;
  }
  const double approach =
      (a.motion.linear - b.motion.linear).norm() + reach_of_turning(a) + reach_of_turning(b);
  if (d.distance > margin * approach) return r;
  const double closing = d.normal.dot(velocity_at(a, d.witness[0]) - velocity_at(b, d.witness[1]));
  if (closing >= d.distance) r.toi = d.distance / closing;
  return r;
}

}  // namespace touchstone
