// Conservative advancement of two convex cores, or of a core against a plane.
#pragma once

#include "core/ccd/impact.h"
#include "core/narrow/convex_core.h"
#include "core/narrow/pair/half_space.h"

namespace touchstone::ccd {

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

/// First contact in [t_start, t_end]; precondition: none before t_start.
ImpactAnswer advance(const MovingCore& a, const MovingCore& b, Wide t_start, Wide t_end);
ImpactAnswer advance(const MovingCore& a, const narrow::WidePlane& plane, Wide t_start, Wide t_end);

}  // namespace touchstone::ccd
