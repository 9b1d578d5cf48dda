// A contradiction is evidence of the fault that explains it: of two answers that cannot both be right, one is
// wrong, and the referee may say which.
#pragma once

#include <optional>

#include "oracles/abi/engine.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

struct PlainForm {
  Case c;
  Finding finding;  // of the engine's answer to it
};

/// The case itself, or the first form that a relation derives from it, in which the referee finds the engine
/// wrong; of several faults there, one about `question` first, then the earliest stage. Empty when it finds
/// none: only the comparison shows that an answer is wrong.
std::optional<PlainForm> plain_form(const Case& c, Question question, const EnginePtr& engine);

}  // namespace touchstone::fuzz
