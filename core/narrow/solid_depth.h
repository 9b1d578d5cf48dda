// How far B must move to leave A, where one of them is a solid that is not convex and the other has an inside
// too.
#pragma once

#include <array>
#include <optional>

#include "core/narrow/narrow_phase.h"

namespace touchstone::narrow {

class SeenShape;

struct WayOut {
  Vec3 normal;                  // unit, A to B
  double depth;                 // moving B by it along `normal` separates them, within a few roundings
  double at_least;              // proven: no motion shorter than this separates them
  std::array<Vec3, 2> witness;  // of A and of B: witness[0] - witness[1] = depth·normal
};

/// `apart`: the distance of what is seen of them; not positive where the surfaces meet. nullopt: no direction
/// of those tried leads out within the limit of steps.
std::optional<WayOut> way_out(const SeenShape& a, const SeenShape& b, const DistanceAnswer& apart);

}  // namespace touchstone::narrow
