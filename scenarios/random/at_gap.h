// A pair whose gap is known by construction.
#pragma once

#include "scenarios/random/place.h"

namespace touchstone::fuzz {

/// Places body 1 so that the point of A farthest along a random direction n (the normal of a half-space) and
/// that of B farthest along −n are `gap` sizes of the pair apart along n: the distance when gap > 0, for a
/// plane between them shows that it is no less; an upper bound of the depth when gap < 0. Of a mesh only the
/// planes are that far apart.
Scene at_gap(Rng& rng, Scene pair, double gap);

}  // namespace touchstone::fuzz
