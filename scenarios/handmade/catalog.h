// All scenarios, in a fixed order.
#pragma once

#include <vector>

#include "scenarios/handmade/scenario.h"

namespace touchstone::scenarios {

std::vector<Scenario> catalog();

}  // namespace touchstone::scenarios
