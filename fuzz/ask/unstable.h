// Answers that are not the same when they are asked for again: made of memory that the engine never wrote, or
// of what it was asked before.
#pragma once

#include <vector>

#include "oracles/abi/engine.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

/// Asks again what is about to be held against the engine, in memory that held something else before. What
/// differs is taken out of `observed`, for it may differ from run to run, and the fault is then `unstable`
/// alone. Answers that were right, and those that took too long, are not asked again.
void set_unstable_aside(const Case& c, Engine& engine, CaseObservations& observed,
                        std::vector<Judgement>& judgements);

/// Whether the engine says of the case what it said before, but for time-outs.
bool repeats(const Case& c, Engine& engine, const CaseObservations& observed);

}  // namespace touchstone::fuzz
