// Is a triangle inside the union of convex pieces? Decided exactly: the pieces are taken away from the
// triangle one after the other, in rational numbers.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "fuzz/cover/exact_hull.h"
#include "oracles/referee/exact/rational.h"

namespace touchstone::fuzz {

using Triangle = std::array<Vec3, 3>;

/// A point of the closed triangle (also one that is flat: a segment or a point) that is in none of the closed
/// hulls; nullopt if every point is in one. Both are exact.
std::optional<referee::Rational3> uncovered_point(const Triangle& t, std::span<const ExactHull> pieces);

}  // namespace touchstone::fuzz
