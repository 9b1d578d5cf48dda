// The smallest case that still shows a finding: greedy reduction to a fixpoint, in the manner of delta
// debugging (Zeller and Hildebrandt 2002, "Simplifying and isolating failure-inducing input", §3): drop
// halves, quarters, …, single elements of every list in the case, then simplify single elements, then round
// numbers.
//
// Guarantee: the result still satisfies `still`, is a valid scene, and is no larger than the case by
// CaseSize. At exit `smallest`, no single reduction of reductions.h makes it smaller: it is a local minimum,
// not necessarily the smallest case overall.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "fuzz/shrink/reductions.h"

namespace touchstone::fuzz {

/// Returns for each case whether it still shows the finding. Deterministic. Takes batches, because engines
/// answer over a pipe.
using StillShows = std::function<std::vector<bool>(std::span<const Case>)>;

enum class ShrinkExit { smallest, out_of_tries, not_shown };
std::string_view to_string(ShrinkExit e);

struct Shrunk {
  Case smallest;
  CaseSize before, after;
  std::size_t tried = 0;  // cases put to `still`
  ShrinkExit exit = ShrinkExit::not_shown;
};

/// At exit `not_shown`, c itself does not show the finding and is returned unchanged.
Shrunk shrink(const Case& c, const StillShows& still, std::size_t max_tries = 20000);

}  // namespace touchstone::fuzz
