// Answers that change when the same question is repeated: they depend on memory that the engine never wrote,
// or on earlier questions.
#pragma once

#include <vector>

#include "oracles/abi/engine.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

/// Repeats the questions whose answers are about to be reported as faults, in memory with other contents.
/// What differs is removed from `observed`, since it may vary from run to run, and the fault becomes
/// `unstable` alone. Right answers and answers that took too long are not repeated.
void remove_unstable(const Case& c, Engine& engine, CaseObservations& observed,
                     std::vector<Judgement>& judgements);

/// Whether the engine repeats its earlier answers to the case, time-outs aside.
bool repeats(const Case& c, Engine& engine, const CaseObservations& observed);

}  // namespace touchstone::fuzz
