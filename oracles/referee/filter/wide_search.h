// The last level for pairs with a curved body of which extended precision cannot tell whether they overlap:
// the same search among numbers of 237 bits. What it finds is a rational plane or a rational point, and it
// counts only when the checker accepts it; so nothing there needs an error bound.
#pragma once

#include "oracles/referee/filter/convex.h"

namespace touchstone::referee {

/// separating_plane (several for a mesh) or common_point, accepted by checker::check(); or none: then nothing is
/// known. Not searched (none): half-spaces, and meshes of so many parts that it would take seconds.
Certificate search_wide(const Placed& a, const Placed& b);

/// The distance of the cores of two convex bodies (balls about them left out) that stand still, at `placed`
/// or as `exact` says.
struct WideGap {
  Real3 direction;  // A to B: where a lower bound is to be looked for
  Real above = 0;   // upper bound: the distance of two points of the cores
};
std::optional<WideGap> wide_gap(const Operand& a, const Operand& b);

}  // namespace touchstone::referee
