// World boxes that provably contain the exact body: extended precision, widened by a forward error bound,
// rounded outward (derivation in body_box.cpp).
#pragma once

#include "core/math/aabb.h"
#include "core/shape/shape.h"

namespace touchstone::broad {

/// Tight up to a few ulp for every bounded shape. A half-space is infinite, except towards a face that is
/// exactly perpendicular to a world axis.
Aabb body_box(const Shape& shape, const Pose& pose);

/// Contains the body at every t in [0,1]. Without rotation: the union of both end boxes. With rotation: the
/// space that the body may turn through, moved along its path. That space is the box at the start widened by
/// bounding radius · angle, or the box of the ball about the body's origin, whichever is tighter on each
/// side.
Aabb swept_box(const Shape& shape, const Pose& pose, const Motion& motion);

/// Contains the body as body_box does, but is computed in double: looser by about 2^-46 of its coordinates
/// and size, and several times cheaper. `size` is box_size of the shape. For a half-space, this is body_box.
Aabb loose_box(const Shape& shape, const Pose& pose, double size);
/// Contains the body at every t in [0,1]. `start` is its box at the start, `reach` its bounding_radius.
Aabb loose_swept_box(const Aabb& start, const Pose& pose, const Motion& motion, double reach);
double box_size(const Shape& shape);

}  // namespace touchstone::broad
