// Exact statements about single points of bodies.
#pragma once

#include <optional>

#include "oracles/referee/referee.h"

namespace touchstone::referee {

// Decides exactly, in 512-bit integers, whether a point is in a body.

/// nullopt: the numbers are too long, or the body is a mesh, a half-space, placed by an affine map, or a cone
/// or ellipsoid without interior.
std::optional<bool> contains_short(const Placed& body, const Vec3& point_w);

// The last level for pairs with a curved body whose bracket contains 0: exact contact. Bodies that touch by
// construction touch at points with simple coordinates; such a point is guessed from the rounded witness and
// accepted only when the checker finds it in both bodies.

/// A common_point, or kind none when no guess is accepted.
Certificate guess_common_point(const std::array<Vec3, 2>& witness, const Placed& a, const Placed& b,
                               int& level);

}  // namespace touchstone::referee
