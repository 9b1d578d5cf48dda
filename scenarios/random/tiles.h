// Crowds in which an error of one ulp makes a broad phase fail: many boxes of very different sizes that touch
// exactly or overlap by a rounding error, on both sides of the origin and far from it, and scripts over them.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

void tiles(Rng& rng, Case& c);
void throng(Rng& rng, Case& c);
void errands(Rng& rng, Case& c);

}  // namespace touchstone::fuzz
