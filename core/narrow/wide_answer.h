// The answers computed in extended precision on the exact pose and rounded once: correct wherever the
// fast answers are undecided, but a hundred times slower.
#pragma once

#include <vector>

#include "core/narrow/manifold.h"
#include "core/narrow/narrow_phase.h"

namespace touchstone::narrow {

OverlapAnswer wide_overlap(const PlacedShape& a, const PlacedShape& b);
DistanceAnswer wide_distance(const PlacedShape& a, const PlacedShape& b);
ContactAnswer wide_contact(const PlacedShape& a, const PlacedShape& b);
/// As contact_within(); every point is as deep as the contact.
ContactAnswer wide_contact_within(const PlacedShape& a, const PlacedShape& b, double margin);

/// The first two, from separation(a, b).
OverlapAnswer overlap_of(const Separation& s);
DistanceAnswer distance_of(const Separation& s, const PlacedShape& a);

/// The points of the manifold of a separation of any sign: for bodies apart, half-way between the witness
/// points. Coordinates are relative to A's translation.
std::vector<ManifoldVertex> manifold_of(const PlacedShape& a, const PlacedShape& b, const Separation& s);

}  // namespace touchstone::narrow
