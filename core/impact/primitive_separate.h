// Directions that keep a moving polygon off the origin, and for how long.
#pragma once

#include "core/impact/primitive_polygon.h"

namespace touchstone::ccd {

/// Directions worth trying at one moment, unit up to rounding, best first: towards the nearest point, the
/// polygon's normal, the nearest corner.
struct Directions {
  std::array<Vec3, 3> n;
  std::size_t count = 0;
};

Directions separating_directions(const MovingPolygon& p, double t);

struct Clearance {
  double until = 0;       // apart over [t, until], proven; equal to t when not even at t
  double separation = 0;  // along the direction at t, rounded; not proven
};

/// How long the polygon stays more than `min_separation` from the origin along n, from t on. The projection
/// of a corner on a fixed direction is linear in time, so that it is enough to look at both ends.
///
/// Bound: n is what it is, three doubles. A projection is three products: errors u of the corner, u of the
/// product, 2u of the sums, each of at most S = Σ|n_c|·M_c: 4.1u·S at t = 0 and t = 1. Its value at t' adds
/// 3u of at most 2S: in all less than 11u·S; 16u·S is asked for, and the smallest normal number for
/// underflow.
Clearance clear_along(const MovingPolygon& p, const Vec3& n, double t, double min_separation);

}  // namespace touchstone::ccd
