// Separating directions of a moving polygon and the origin, and how long they are valid.
#pragma once

#include "core/impact/primitive_polygon.h"

namespace touchstone::impact {

/// Candidate directions at one time, unit up to rounding, best first: towards the nearest point, the
/// polygon's normal, the nearest corner.
struct Directions {
  std::array<Vec3, 3> n;
  std::size_t count = 0;
};

Directions separating_directions(const MovingPolygon& p, double t);

struct Clearance {
  double until = 0;       // apart over [t, until], proven; t if not separated at t
  double separation = 0;  // along the direction at t; rounded, not proven
};

/// How long from t on the polygon stays more than `min_separation` from the origin along n. The projection of
/// a corner on a fixed direction is linear in time, so it suffices to check both ends.
///
/// Bound: n is taken as exactly its three doubles. A projection is three products: errors u of the corner, u
/// of the product, 2u of the sums, each of at most S = Σ|n_c|·M_c: 4.1u·S at t = 0 and t = 1. Its value at t'
/// adds 3u of at most 2S: in total less than 11u·S. The code requires 16u·S, plus the smallest normal number
/// for underflow.
Clearance clear_along(const MovingPolygon& p, const Vec3& n, double t, double min_separation);

}  // namespace touchstone::impact
