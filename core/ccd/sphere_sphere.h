// Two balls: |p + t v| = R. Turning does nothing to a ball about its own centre.
#pragma once

#include "core/ccd/advance.h"

namespace touchstone::ccd {

ImpactAnswer sphere_sphere(const MovingCore& a, const MovingCore& b);

}  // namespace touchstone::ccd
