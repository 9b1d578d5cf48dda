#pragma once

#include "core/ccd/time_of_impact.h"

namespace touchstone {

/// Closed form: the spheres' centres are their bodies' origins, so that rotation does not matter.
TimeOfImpact sphere_sphere_impact(const MovingShape& a, const MovingShape& b);

}  // namespace touchstone
