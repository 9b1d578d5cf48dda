// What an engine's answers do from one frame of a motion to the next that the truth does not, and what they
// owe to earlier frames (docs/truth.md §7). Pure, like the judge.
#pragma once

#include <string>
#include <vector>

#include "fuzz/judge/truth.h"
#include "scenarios/value/engine_card.h"
#include "scenarios/value/flicker.h"

namespace touchstone::fuzz {

/// The answer to one question in one frame.
struct AnsweredFrame {
  Truth& truth;
  const Observation& answer;
};

struct FrameChange {
  bool compared = false;  // both were answered
  /// The normal jumped, and the referee proved that the one before now needs more: the features named are
  /// those of the old and of the new normal.
  bool true_switch = false;
  std::string switch_words;
  /// By how much more than the referee's normal the stated one turned, where both stay on one feature: an
  /// angle.
  double restless = 0;
  std::vector<FlickerReport> flickers;
};

/// `frame`: number of the later one. The same bodies and question in both.
FrameChange change_between(const AnsweredFrame& before, const AnsweredFrame& after, const Query& q,
                           const EngineCard& card, int frame);

/// How the answer of an engine that had seen the earlier frames differs from its answer without them, by more
/// than its tolerance: one sentence; empty: it does not.
std::string difference_by_state(const EngineCard& card, Truth& truth, const Query& q,
                                const Observation& in_order, const Observation& alone);

}  // namespace touchstone::fuzz
