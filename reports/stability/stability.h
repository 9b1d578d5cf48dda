// Climbs ladders: asks engines at every rung, judges, and asks again in other forms: with B an ulp away, with
// A and B exchanged, in other frames, in another unit.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "oracles/abi/engine.h"
#include "reports/record/stability.h"

namespace touchstone::fuzz {

/// `ladder`: its name, or empty for all. Throws InputError when there is no such ladder.
Stability climb(const std::string& ladder, std::uint64_t seed, int per_rung,
                std::span<const EnginePtr> engines, const std::function<void(const std::string&)>& progress);

}  // namespace touchstone::fuzz
