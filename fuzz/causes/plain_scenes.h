// Scenes that anyone would write by hand, the plainest first: a row of cubes or spheres that touch, and what
// differs from that in one respect. For questions about whole scenes.
#pragma once

#include <vector>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// With the queries and the margin of the case. With `moving`, the second body reaches the first during the
/// step; otherwise nothing moves. Scripts are made for questions that run them.
std::vector<Case> plain_scenes(const Case& c, bool moving);

}  // namespace touchstone::fuzz
