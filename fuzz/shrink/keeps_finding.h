// What the shrinker keeps: an engine is found wrong under the same key.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fuzz/shrink/shrink.h"
#include "oracles/abi/engine.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// Who says what is wrong: the referee, the relations (judge/relation.h), or both.
enum class FoundBy { referee, relations, both };

/// For each case, what the engine is found wrong about, by key (record/result.h).
std::vector<std::map<std::string, Finding>> findings_of(std::span<const Case> cases, const EnginePtr& engine,
                                                        FoundBy by = FoundBy::referee);

/// Who says what is found under this key.
FoundBy found_by(const std::string& key);

/// `engine` must outlive the result.
StillShows keeps_finding(const EnginePtr& engine, std::string key);

}  // namespace touchstone::fuzz
