// What a fault is to be blamed on: the finite bodies, or an infinite or invalid box beside them. The subject
// is asked again without such boxes; what it does then is a fault of finite bodies.
#pragma once

#include "fuzz/certify/candidate_verdict.h"
#include "oracles/abi/engine.h"
#include "reports/record/broad_certificate.h"

namespace touchstone::fuzz {

/// judge_candidates of the answer `o` of `engine`, with the kinds `unbounded` and `invalid` where the fault
/// is gone without such boxes.
CandidateVerdict judge_with_cause(Engine& engine, const Case& c, const Observation& o, BroadLevel level,
                                  bool invalid);

}  // namespace touchstone::fuzz
