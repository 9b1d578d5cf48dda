// Does an engine speak the interface as it is meant? Easy questions, each of which catches one mistake that
// is usual when a detector is put behind the interface; what is wrong is said in words. Not a test of
// accuracy: a fault of an ulp is none here.
#pragma once

#include <string>
#include <vector>

#include "oracles/abi/engine.h"

namespace touchstone::fuzz {

struct Remark {
  std::string probe;    // what was asked
  std::string verdict;  // "right", "unsupported", "wrong"
  std::string words;    // of a wrong one: what came, what was right, what it usually means
};

/// One a probe, in a fixed order.
std::vector<Remark> conformance(Engine& engine);

}  // namespace touchstone::fuzz
