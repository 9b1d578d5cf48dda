// Random shapes of size about 1 (half extents 0.3 to 1.2) times `scale`.
#pragma once

#include "core/math/rng.h"
#include "core/shape/shape.h"

namespace touchstone::fuzz {

Shape random_shape(Rng& rng, ShapeKind kind, double scale);

/// Convex kinds only, with equal probability.
ShapeKind random_convex_kind(Rng& rng);

/// Support value max n·x over the shape in its body frame; +inf for a half-space unless n is its normal.
double support_value(const Shape& shape, const Vec3& n_local);

}  // namespace touchstone::fuzz
