// What is proven about deforming primitives: in doubles by the sign of the signed volume spanned by the
// polygon's plane and the origin, a cubic in time; and in integers, with no false verdicts, whatever the
// coordinates.
#pragma once

#include "core/impact/primitive_impact.h"
#include "core/impact/primitive_polygon.h"

namespace touchstone::impact {

/// A time up to which, from t on, the volume is proven to be non-zero, so that the origin is not in the
/// polygon's plane; t if nothing is proven.
double volume_clear_until(const MovingPolygon& p, double t);

/// True: the polygon is proven to contain the origin at some time near t. False: undecided.
bool crosses_near(const MovingPolygon& p, double t);

struct ExactImpact {
  bool collides = false;
  double t_below = 0;  // never later than the first contact
};

/// Precondition: no contact in [0, clear_until), all coordinates finite. `narrow`: t_below must be within
/// 2^-49 of the first contact; otherwise `clear_until` suffices if contact follows within 2^-20.
ExactImpact decide_exactly(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                           const std::array<Vec3, 4>& end, double clear_until, bool narrow);

}  // namespace touchstone::impact
