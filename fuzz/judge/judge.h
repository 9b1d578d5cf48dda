// The judge: a pure function of a case, the engines' observations and cards, and the referee. It runs no
// engine, reads no clock and draws no random number, so a stored run can be judged again.
#pragma once

#include <span>
#include <vector>

#include "fuzz/judge/truth.h"
#include "scenarios/value/engine_card.h"
#include "scenarios/value/judgement.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

/// One judgement per query of the case. `truth` belongs to the same case and keeps what it learns for the
/// next engine.
std::vector<Judgement> judge(const Case& c, const EngineCard& card, const CaseObservations& observations,
                             Truth& truth);

}  // namespace touchstone::fuzz
