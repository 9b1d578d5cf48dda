// Exact world coordinates in rationals, plain and slow: for half-spaces, certificates and other rare uses.
#pragma once

#include <vector>

#include "oracles/referee/exact/exact_pair.h"

namespace touchstone::referee {

Rational3 world_point(const std::variant<Pose, Placement>& pose, const Rational3& local);
/// The core points at the first time only.
std::vector<Rational3> world_points(const ExactBody& b);

struct RationalPlane {
  Rational3 normal;  // {x : normal·x <= offset}, world; zero for a singular placement
  Rational offset;
};
RationalPlane world_plane(const Placed& half_space);

}  // namespace touchstone::referee
