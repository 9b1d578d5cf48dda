// Engines that lie about motions in frames. Each is found by what it does between frames, or by state that it
// keeps; a campaign, which sees no frames, does not look for these.
#pragma once

#include <string_view>
#include <vector>

#include "oracles/abi/engine.h"
#include "tests/mutants/mutant.h"

namespace touchstone::mutants {

struct MotionLie {
  std::string_view name;
  std::string_view found;   // "wrong", "state", or the kind of flicker by which it must be found
  std::string_view motion;  // a row of the motions, or a scenario, where it shows
  std::string_view line;    // what is wrong with it, for readers
  Lie lie;
  /// A tolerance that its card claims, so that it is right within it; 0: none.
  double claim = 0;
  bool is_wrong = false;  // a frame's answer may be wrong as well
};

const std::vector<MotionLie>& motion_lies();

EnginePtr make_motion_liar(const MotionLie& m);
/// Makes such an engine forget what it was asked; false for any other engine.
bool forget_motion(Engine& e);

}  // namespace touchstone::mutants
