// Pairs in which each body has an axis of symmetry, and the axes are parallel: the depth problem has a
// continuum of nearly equal directions, for which a polytope needs 10^7 facets. Symmetry reduces it to a
// plane, where a polygon needs forty edges.
//
// Derivation. Let u be the common axis direction and e = c_A - c_B. For n = n_u·u + n_r (n_r perpendicular to
// u), h_A and h_(-B) about their centres depend only on n_u and |n_r|, and h_D(n) adds n·e = n_u e_u +
// n_r·e_r. For given n_u and |n_r| that is least when n_r points against e_r. So the least h_D(n)/|n| is
// among the n in the plane of u and e_r, where h_D is the support function of the difference of the two
// meridian sections. Axes that are parallel only up to rounding: each body is within `slack` (Hausdorff) of
// one whose axis is exactly parallel, and the depth differs by at most that.
#pragma once

#include "oracles/referee/filter/minkowski.h"

namespace touchstone::referee {

struct MeridianBound {
  bool applies = false;
  CoreGap gap;
};
MeridianBound meridian_bound(const Difference& d, Real target);

}  // namespace touchstone::referee
