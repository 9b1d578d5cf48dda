// Deforming primitives decided in integers: no false verdict, whatever the coordinates.
#pragma once

#include "core/impact/primitive_impact.h"

namespace touchstone::ccd {

struct ExactImpact {
  bool collides = false;
  double t_below = 0;  // never later than the first contact
};

/// No contact in [0, clear_until) is known beforehand; `narrow`: t_below is to be within 2^-49 of the first
/// contact, otherwise `clear_until` will do where contact follows within 2^-20. All coordinates finite.
ExactImpact decide_exactly(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                           const std::array<Vec3, 4>& end, double clear_until, bool narrow);

}  // namespace touchstone::ccd
