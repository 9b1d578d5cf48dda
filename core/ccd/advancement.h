// Conservative advancement for two convex bodies (Mirtich 1996; directional bounds after Zhang, Lee, Kim
// 2006), with a bound of second order.
#pragma once

#include "core/ccd/time_of_impact.h"

namespace touchstone {

/// `scale` is L of the pair over the whole step.
TimeOfImpact advance(const MovingShape& a, const MovingShape& b, double scale);

}  // namespace touchstone
