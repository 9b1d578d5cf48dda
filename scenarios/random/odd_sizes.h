// Pairs whose sizes are unusual: zero (points, segments, discs, plates), or very different; and boxes and
// prisms whose edges are all but parallel.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

void zero_sizes(Rng& rng, Case& c);
void unequal_sizes(Rng& rng, Case& c);
void nearly_parallel(Rng& rng, Case& c);

/// Sets one size of the shape to zero, or several, or all. Ellipsoids, half-spaces and meshes stay as they
/// are.
void flatten(Rng& rng, Shape& shape);

/// The gap of a pair of the given size: zero, of 2^-40 to 2^-7 of it with either sign, or of its order.
double any_gap(Rng& rng, double size);

/// Body 1 becomes body 0 and the other way round.
void exchange_bodies(Scene& pair);

}  // namespace touchstone::fuzz
