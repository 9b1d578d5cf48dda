// Judges whether one answer about candidate pairs is conservative. A pure function.
#pragma once

#include <string>

#include "oracles/abi/engine.h"
#include "reports/record/broad_certificate.h"
#include "scenarios/exhaustive/evidence.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

struct CandidateFault {
  FaultClass what;
  std::string words;
  int query = -1, a = -1, b = -1;
  double share = 0;  // FaultCount::share
};

struct CandidateVerdict {
  /// At most one per class, the gravest class first; of several in a class, the one with the largest share.
  std::vector<CandidateFault> faults;
  bool refused = false;    // unsupported or invalid input: not an answer, not a fault
  bool timed_out = false;  // not an answer, not a fault
  std::string words;       // why there is no answer
  std::uint64_t steps = 0, queries = 0, pairs_true = 0, pairs_reported = 0, undecided = 0;
  std::uint64_t digest = 0;  // over the case and the answer

  bool shows(const FaultClass& c) const;
};

/// The kind of a fault describes the pair only; blaming an infinite or invalid box elsewhere in the scene is
/// left to judge_with_cause. At the level of boxes every body must have an exact_box, or InputError is
/// thrown; `invalid` admits bodies without one, or with an empty one, and does not require them to be paired.
CandidateVerdict judge_candidates(const Case& c, const Observation& answer, BroadLevel level,
                                  bool invalid = false);

/// Judges the answer `o` of `engine` like judge_candidates, and sets the kind to `unbounded` or `invalid`
/// where the fault disappears without such boxes.
CandidateVerdict judge_with_cause(Engine& engine, const Case& c, const Observation& o, BroadLevel level,
                                  bool invalid);

}  // namespace touchstone::fuzz
