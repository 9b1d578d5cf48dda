// A scenario: a handmade case that targets one way in which collision engines fail. Where a closed form
// exists, the truth is derived on paper.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenarios/value/case.h"
#include "scenarios/value/expectation.h"

namespace touchstone::scenarios {

struct Scenario {
  std::string name;    // unique over all folders
  std::string folder;  // touching, thin, far, deep, degenerate, motion, crowd, lifecycle
  std::string line;    // summary for display
  std::function<Case()> make;
  Expectation expect;
};

// All scenarios, in a fixed order.

std::vector<Scenario> catalog();

}  // namespace touchstone::scenarios
