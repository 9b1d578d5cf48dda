// Time of impact the discrete way, out of any engine that answers overlap: the bodies stand at k + 1 times of
// the step, ends included, and the first time at which they overlap is the answer. What a simulation does
// that takes k small steps instead of sweeping: it finds contacts late and misses those between two times.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "oracles/abi/engine.h"

namespace touchstone::fuzz {

/// Answers time_of_impact and nothing else, as `<engine>-steps@<steps>`. Its time is that of the overlaps
/// asked up to the first that is true. Several may share one inner engine. Precondition: steps ≥ 1.
EnginePtr sub_stepped(std::shared_ptr<Engine> inner, int steps);

/// "core-steps@16" is {"core", 16}; empty when the name is not of that form or the number not in 1 … 1e6.
struct SubStepsName {
  std::string engine;
  int steps = 0;
};
std::optional<SubStepsName> sub_steps_name(const std::string& name);

}  // namespace touchstone::fuzz
