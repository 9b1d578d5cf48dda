// Is one answer about candidate pairs conservative? Pure.
#pragma once

#include <string>

#include "scenarios/exhaustive/evidence.h"
#include "scenarios/value/judgement.h"
#include "reports/record/broad_certificate.h"

namespace touchstone::fuzz {

struct CandidateFault {
  FaultClass what;
  std::string words;
  int query = -1, a = -1, b = -1;
  double share = 0;  // FaultCount::share
};

struct CandidateVerdict {
  /// One of each class at most, the gravest class first; of several of a class the one of the largest share.
  std::vector<CandidateFault> faults;
  bool refused = false;    // unsupported or invalid input: no answer, no fault
  bool timed_out = false;  // no answer, no fault
  std::string words;       // why there is no answer
  std::uint64_t steps = 0, queries = 0, pairs_true = 0, pairs_reported = 0, undecided = 0;
  std::uint64_t digest = 0;  // of the case and the answer

  bool shows(const FaultClass& c) const;
};

/// Kinds are those of the pair: a fault of finite bodies is not blamed on an infinite or invalid box beside
/// them (fault_cause.h does that). At the level of boxes every body must have an exact_box (InputError else);
/// `invalid` admits those that have none or an empty one, of which nothing is asked.
CandidateVerdict judge_candidates(const Case& c, const Observation& answer, BroadLevel level,
                                  bool invalid = false);

}  // namespace touchstone::fuzz
