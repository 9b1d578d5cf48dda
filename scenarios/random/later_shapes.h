// Random cases with the convex shapes that came later than common_convex_kinds (random_shape.h).
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// Such a shape against another of any kind: apart, near, deep, concentric or in motion; some are parallel,
/// and one in four has a thin size or sizes of zero.
void later_shapes(Rng& rng, Case& c);

}  // namespace touchstone::fuzz
