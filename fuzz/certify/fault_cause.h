// Decides what a fault is blamed on: the finite bodies, or an infinite or invalid box elsewhere in the scene.
// The subject is queried again without such boxes; a fault that remains is one of finite bodies.
#pragma once

#include "fuzz/certify/candidate_verdict.h"
#include "oracles/abi/engine.h"
#include "reports/record/broad_certificate.h"

namespace touchstone::fuzz {

/// Judges the answer `o` of `engine` like judge_candidates, and sets the kind to `unbounded` or `invalid`
/// where the fault disappears without such boxes.
CandidateVerdict judge_with_cause(Engine& engine, const Case& c, const Observation& o, BroadLevel level,
                                  bool invalid);

}  // namespace touchstone::fuzz
