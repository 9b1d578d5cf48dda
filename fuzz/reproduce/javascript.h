// The program of a finding of an engine from npm: one JavaScript module that imports only the engine's
// package and runs under Node.js.
#pragma once

#include <string>

#include "fuzz/judge/truth.h"
#include "oracles/reproducer/engine_source.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// `tau`: the tolerance of the check. Throws InputError if no program checks the fault.
std::string javascript_program(const Finding& finding, const EngineCard& card, const EngineQuestion& q,
                               const EngineSource& source, Truth& truth, double tau);

}  // namespace touchstone::fuzz
