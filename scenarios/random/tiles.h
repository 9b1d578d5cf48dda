// Crowds that a broad phase gets wrong by an ulp: boxes that touch exactly or overlap by a rounding, on both
// sides of the origin and far from it, of very different sizes, in numbers, and scripts over them.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

void tiles(Rng& rng, Case& c);
void throng(Rng& rng, Case& c);
void errands(Rng& rng, Case& c);

}  // namespace touchstone::fuzz
