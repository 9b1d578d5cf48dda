// Bounds of the depth by parts of the bodies. Where a vertex or an edge of one body lies on the axis of a
// body of revolution, a whole arc of directions is equally good, and an inner polytope needs 10^7 facets to
// show it; the vertex or the edge by itself is a body of revolution too, and meridian_bound measures it in a
// plane.
//
// Derivation. For A' in A and B' in B, h_A' <= h_A and h_B' <= h_B, so the depth of (A', B') is at most that
// of (A, B): a lower bound of the depth of the parts is one of the bodies. The best direction of the parts is
// tried for the bodies, as an upper bound. Both are equal where the parts alone decide.
#pragma once

#include "oracles/referee/filter/gjk.h"

namespace touchstone::referee {

/// Narrows `gap`, the bracket for the cores of d. `nearest`: the facet or simplex of d that is nearest to the
/// origin, with weights; any will do, but only a good one helps. Stops when the bracket is within `target`.
void bound_by_parts(const Difference& d, const Simplex& nearest, Real target, CoreGap& gap);

}  // namespace touchstone::referee
