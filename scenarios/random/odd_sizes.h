// Pairs whose sizes are unusual: zero (points, segments, discs, plates), or very different; and boxes and
// prisms whose edges are almost parallel.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

void zero_sizes(Rng& rng, Case& c);
void unequal_sizes(Rng& rng, Case& c);
void nearly_parallel(Rng& rng, Case& c);

/// Sets one, several or all sizes of the shape to zero. Ellipsoids, half-spaces and meshes are unchanged.
void flatten(Rng& rng, Shape& shape);

/// A gap for a pair of the given size: zero, 2^-40 to 2^-7 of the size with either sign, or comparable to the
/// size.
double any_gap(Rng& rng, double size);

/// Swaps bodies 0 and 1.
void exchange_bodies(Scene& pair);

}  // namespace touchstone::fuzz
