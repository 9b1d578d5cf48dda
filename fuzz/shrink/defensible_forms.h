// Cases near a given one that may be defensible: what a person would try by hand.
#pragma once

#include <vector>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// The case itself, then changed ones, smallest change first: with plain numbers and volume, B moved so that
/// the pair clearly overlaps or is clearly apart, an approach that meets within the step, all shapes a little
/// larger or smaller. Only valid scenes; up to about a hundred. Whether they are defensible is not examined.
std::vector<Case> defensible_forms(const Case& c);

}  // namespace touchstone::fuzz
