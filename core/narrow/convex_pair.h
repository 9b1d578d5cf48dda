// Signed separation of two convex cores by GJK and, when they touch or overlap, EPA.
#pragma once

#include "core/narrow/convex_core.h"
#include "core/narrow/result.h"

namespace touchstone::narrow {

/// The length that tolerances of the pair are relative to.
Wide pair_size(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b);

/// Both cores in coordinates near the pair. Never throws; not_converged when slack exceeds
/// narrow_accept_factor·size.
Separation separate_convex(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b);

/// Core points a, b and a unit direction, proposed by a closed form: accepted as the answer when the
/// direction's support planes prove |b − a| to be the distance, else the general algorithm answers.
Separation certified_or_general(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b, const WideVec& point_a,
                                const WideVec& point_b, const WideVec& normal);

/// The same pair seen from the other side, in the same coordinates.
Separation mirrored(Separation s);

}  // namespace touchstone::narrow
