// Discrete time of impact from any engine that answers overlap: tests the bodies at k + 1 times of the step,
// ends included, and answers with the first time at which they overlap. This is what a simulation does that
// takes k small steps instead of sweeping: it finds contacts late and misses those between two times.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "oracles/abi/engine.h"

namespace touchstone::fuzz {

/// An engine named `<engine>-steps@<steps>` that answers only time_of_impact. Its time is that of the overlap
/// queries up to the first overlap. Several may share one inner engine. Precondition: steps ≥ 1.
EnginePtr sub_stepped(std::shared_ptr<Engine> inner, int steps);

/// "core-steps@16" is {"core", 16}. Empty when the name does not have this form or the number is not in 1 …
/// 1e6.
struct SubStepsName {
  std::string engine;
  int steps = 0;
};
std::optional<SubStepsName> sub_steps_name(const std::string& name);

}  // namespace touchstone::fuzz
