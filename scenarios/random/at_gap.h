// A pair with a gap that is known by construction.
#pragma once

#include "scenarios/random/place.h"

namespace touchstone::fuzz {

/// Places body 1 so that the point of A farthest along a random direction n (the normal of a half-space) and
/// the point of B farthest along −n are `gap` · (size of the pair) apart along n. When gap > 0 this is the
/// distance, because a plane between the bodies proves that it is no less; when gap < 0 it bounds the depth
/// from above. For a mesh only the support planes are that far apart.
Scene at_gap(Rng& rng, Scene pair, double gap);

}  // namespace touchstone::fuzz
