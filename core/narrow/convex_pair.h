// Signed separation of two convex cores by GJK and, when they touch or overlap, EPA.
#pragma once

#include "core/narrow/convex_core.h"
#include "core/narrow/result.h"

namespace touchstone::narrow {

/// The length that the tolerances of the pair are relative to.
Wide pair_size(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b);

/// Both cores are in coordinates near the pair. Never throws; `not_converged` when the slack exceeds
/// narrow_accept_factor·size.
Separation separate_convex(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b);

/// Takes core points a, b and a unit direction proposed by a closed form. They are the answer if the
/// direction's support planes prove that |b − a| is the distance; otherwise the general algorithm is used.
Separation certified_or_general(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b, const WideVec& point_a,
                                const WideVec& point_b, const WideVec& normal);

/// Swaps the roles of A and B, in the same coordinates.
Separation mirrored(Separation s);

}  // namespace touchstone::narrow
