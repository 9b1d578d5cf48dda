// A scenario: a case built by hand, aimed at one way in which collision engines fail, with what is true of it
// derived on paper wherever there is a closed form.
#pragma once

#include <functional>
#include <string>

#include "scenarios/value/case.h"
#include "scenarios/value/expectation.h"

namespace touchstone::scenarios {

struct Scenario {
  std::string name;    // unique over all folders
  std::string folder;  // touching, thin, far, deep, degenerate, motion, crowd, lifecycle
  std::string line;    // what it is, and whom it hurts
  std::function<Case()> make;
  Expectation expect;
};

}  // namespace touchstone::scenarios
