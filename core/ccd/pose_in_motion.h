// The pose at a time of a motion, with angles worked out in long double: at 500 rad a step, an angle rounded
// to double would already be off by more than the tolerance of the whole query.
#pragma once

#include "core/math/pose.h"

namespace touchstone {

Pose pose_in_motion(const Pose& start, const Motion& motion, double t);

}  // namespace touchstone
