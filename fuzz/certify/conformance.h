// Checks that an engine implements the interface as intended. Each easy question catches one common mistake
// in an adapter, and the remark explains it. This is not a test of accuracy: an error of an ulp is not a
// fault here.
#pragma once

#include <string>
#include <vector>

#include "oracles/abi/engine.h"

namespace touchstone::fuzz {

struct Remark {
  std::string probe;    // name of the question
  std::string verdict;  // "right", "unsupported", "wrong"
  std::string words;    // if wrong: the answer, the right answer, the usual cause
};

/// One remark per probe, in a fixed order.
std::vector<Remark> conformance(Engine& engine);

}  // namespace touchstone::fuzz
