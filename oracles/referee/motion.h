// Boxes of moving parts; the rest of the motion's interface is in referee.h.
#pragma once

#include "core/math/aabb.h"
#include "oracles/referee/mover.h"

namespace touchstone::referee {

/// Outward box of the part over the whole step, relative to `origin` (which is exact).
Aabb box_over(const Mover& m, const Vec3& origin);

}  // namespace touchstone::referee
