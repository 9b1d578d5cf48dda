// The last level for pairs with a curved body whose bracket contains 0: exact contact. Bodies that touch by
// construction touch at points with simple coordinates; such a point is guessed from the rounded witness and
// accepted only when the checker finds it in both bodies.
#pragma once

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// A common_point, or kind none when no guess is accepted.
Certificate guess_common_point(const std::array<Vec3, 2>& witness, const Placed& a, const Placed& b,
                               int& level);

}  // namespace touchstone::referee
