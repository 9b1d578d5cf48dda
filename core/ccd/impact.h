// Time of impact under constant velocities (core/math/pose.h, Motion), t in [0,1].
#pragma once

#include <optional>

#include "core/base/outcome.h"
#include "core/shape/shape.h"

namespace touchstone {

struct MovingShape {
  const Shape* shape = nullptr;
  Pose pose;
  Motion motion;
};

struct ImpactAnswer {
  Outcome outcome = Outcome::answered;
  /// Set: contact at this time; never after first contact by more than the rounding of t to double. Not set
  /// with `answered`: the gap is proven positive over [0,1].
  std::optional<double> toi;
  double separation = 0;   // signed gap at `toi`, or at the end of the proven interval
  double clear_until = 0;  // no contact before this time: proven, also when not_converged
  int steps = 0;
};

/// Every pair of the narrow phase. A mesh or half-space with a velocity is unsupported: they are static
/// shapes.
ImpactAnswer time_of_impact(const MovingShape& a, const MovingShape& b);

}  // namespace touchstone
