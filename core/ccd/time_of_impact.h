// Time of impact under constant linear and angular velocity over t in [0,1] (motion: core/math/pose.h).
//
// Guarantee, one-sided: the time reported is never later than the first contact, but for rounding; at the
// time reported the gap is at most a few roundings of the scene's scale L. "No hit" is only answered when a
// chain of separating directions covers [0,1]. Anything else is not_converged with the time up to which the
// bodies are known to be apart.
#pragma once

#include "core/narrow/narrow_phase.h"
#include "core/scene/scene.h"

namespace touchstone {

struct MovingShape {
  const Shape* shape = nullptr;
  Pose pose;  // at t = 0
  Motion motion;
};

struct TimeOfImpact {
  Outcome outcome = Outcome::answered;
  bool hit = false;
  double t = 1;    // of a hit; otherwise apart on [0, t]
  double gap = 0;  // at t: what separates the bodies there, >= 0 but for rounding; < 0: overlap at the start
  Vec3 normal = Vec3::Zero();                               // of a hit: A to B at t
  std::array<Vec3, 2> witness{Vec3::Zero(), Vec3::Zero()};  // of a hit: closest points at t
  int steps = 0;
};

/// Mesh against convex: the first of its triangles. Mesh against mesh, half-space against half-space:
/// unsupported.
TimeOfImpact time_of_impact(const MovingShape& a, const MovingShape& b);

}  // namespace touchstone
