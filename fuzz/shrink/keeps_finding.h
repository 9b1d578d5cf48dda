// What the shrinker keeps: an engine is wrong in the same way, by an error of the same magnitude, and solid
// bodies stay solid, so that a finding does not slide into another one on the way down.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fuzz/shrink/shrink.h"
#include "oracles/api/engine.h"

namespace touchstone::fuzz {

/// Key of a finding (record/result.h) -> worst error in L, for each case.
std::vector<std::map<std::string, double>> findings_of(std::span<const Case> cases, const EnginePtr& engine);

/// `c`: the case to be shrunk; `engine` must outlive the result.
StillShows keeps_finding(const EnginePtr& engine, const Case& c, std::string key, double error_in_l);

}  // namespace touchstone::fuzz
