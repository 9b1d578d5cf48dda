// The three answers computed in extended precision on the exact pose and rounded once: correct wherever the
// fast answers are undecided, but a hundred times slower.
#pragma once

#include "core/narrow/narrow_phase.h"

namespace touchstone::narrow {

OverlapAnswer wide_overlap(const PlacedShape& a, const PlacedShape& b);
DistanceAnswer wide_distance(const PlacedShape& a, const PlacedShape& b);
ContactAnswer wide_contact(const PlacedShape& a, const PlacedShape& b);

/// The first two, from separation(a, b).
OverlapAnswer overlap_of(const Separation& s);
DistanceAnswer distance_of(const Separation& s, const PlacedShape& a);

}  // namespace touchstone::narrow
