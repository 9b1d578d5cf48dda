// Of two forms of a case that contradict each other, one is answered wrongly. Which one, only a judge can
// tell.
#pragma once

#include <optional>
#include <span>

#include "oracles/abi/engine.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// A form of a case, and the worst fault of the engine's answer to it.
struct FailingForm {
  Case c;
  Finding finding;
};

/// Of the forms that the relation (fuzz/judge/relation.h) derives from the cases and that contradict the
/// engine's answers to them, the first whose own answer to that question the referee finds wrong. Empty when
/// there is none: the engine gives no answer, or each answer alone is within its tolerance.
std::optional<FailingForm> failing_form(std::span<const Case* const> cases, const std::string& relation,
                                        const EnginePtr& engine);

}  // namespace touchstone::fuzz
