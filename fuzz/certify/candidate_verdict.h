// Is one answer about candidate pairs conservative? Pure.
#pragma once

#include <string>

#include "fuzz/certify/evidence.h"
#include "fuzz/judge/judgement.h"

namespace touchstone::fuzz {

struct CandidateVerdict {
  /// Empty: nothing wrong. "missed", "stale", "no_number", or the outcome of an engine that failed.
  std::string fault;
  std::string words;
  int query = -1, a = -1, b = -1;
  bool refused = false;  // unsupported or invalid input: no answer, no fault
  std::uint64_t steps = 0, queries = 0, pairs_true = 0, pairs_reported = 0, undecided = 0;
  std::uint64_t digest = 0;  // of the case and the answer
};

/// The first wrong query, the first pair of it. At the level of boxes every body must have an exact_box
/// (InputError else); `invalid` admits those that have none or an empty one, of which nothing is asked.
CandidateVerdict judge_candidates(const Case& c, const Observation& answer, Level level,
                                  bool invalid = false);

}  // namespace touchstone::fuzz
