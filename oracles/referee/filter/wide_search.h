// The last level for pairs with a curved body for which extended precision cannot tell whether they overlap:
// the same search in 237-bit arithmetic. Its result is a rational plane or a rational point and counts only
// when the checker accepts it, so nothing there needs an error bound.
#pragma once

#include "oracles/referee/filter/convex.h"

namespace touchstone::referee {

/// A separating_plane (several for a mesh) or common_point accepted by checker::check(), or kind none when
/// nothing is found. Half-spaces, and meshes of so many parts that it would take seconds, are not searched
/// (none).
Certificate search_wide(const Placed& a, const Placed& b);

/// Distance of the cores (without the balls) of two convex bodies at rest, at `placed` or at the pose in
/// `exact`.
struct WideGap {
  Real3 direction;  // A to B: the direction along which to look for a lower bound
  Real above = 0;   // upper bound: the distance of two points of the cores
};
std::optional<WideGap> wide_gap(const Operand& a, const Operand& b);

}  // namespace touchstone::referee
