// Conservative advancement of two convex cores, or of a core against a plane.
#pragma once

#include <limits>

#include "core/impact/impact.h"
#include "core/narrow/convex_core.h"
#include "core/narrow/pair/half_space.h"

namespace touchstone::impact {

using Core = narrow::ConvexCore<Wide>;

/// A core at t = 0 and how it moves.
struct MovingCore {
  Core start;
  WideMat rotation;  // of the pose at t = 0
  WideVec linear = WideVec::Zero(), angular = WideVec::Zero();
};

MovingCore moving_core(const Core& start, const Motion& motion);

/// The core at time t with `origin` subtracted from its translation.
Core at_time(const MovingCore& c, Wide t, const WideVec& origin);

struct Advance {
  ImpactAnswer answer;  // with `gap_opened`: what is clear so far
  bool gap_opened = false;
};

/// When an advance ends.
struct Goal {
  Wide end = 1;
  double accuracy = 0;  // a gap of at most this is contact if its bounds have not converged
  /// A step to where the gap exceeds this ends the advance with `gap_opened`: extended precision is not
  /// needed there.
  Wide leave = std::numeric_limits<Wide>::infinity();
};

/// First contact from t_start on; precondition: no contact before t_start.
Advance advance(const MovingCore& a, const MovingCore& b, Wide t_start, const Goal& goal);
Advance advance(const MovingCore& a, const narrow::WidePlane& plane, Wide t_start, const Goal& goal);

}  // namespace touchstone::impact
