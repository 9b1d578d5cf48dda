// A box that contains a placed body, for ts_scene::step_boxes. Shares no code with the boxes of the core's
// broad phases.
#pragma once

#include "core/math/aabb.h"
#include "core/math/pose.h"
#include "core/shape/shape.h"

namespace touchstone {

/// Rounded outward; infinite for a half-space. Exact up to the last rounding if the rotation is the identity.
/// A shape of negative or NaN sizes gives a box whose upper side is below its lower one, or NaN.
Aabb outer_box(const Shape& shape, const Pose& pose);

}  // namespace touchstone
