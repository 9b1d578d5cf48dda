// Deforming primitives decided in integers: no false verdicts, whatever the coordinates.
#pragma once

#include "core/impact/primitive_impact.h"

namespace touchstone::impact {

struct ExactImpact {
  bool collides = false;
  double t_below = 0;  // never later than the first contact
};

/// Precondition: no contact in [0, clear_until), all coordinates finite. `narrow`: t_below must be within
/// 2^-49 of the first contact; otherwise `clear_until` suffices if contact follows within 2^-20.
ExactImpact decide_exactly(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                           const std::array<Vec3, 4>& end, double clear_until, bool narrow);

}  // namespace touchstone::impact
