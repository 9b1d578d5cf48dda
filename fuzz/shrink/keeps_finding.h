// The shrinker's criterion: the engine is still found wrong under the same key.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fuzz/shrink/shrink.h"
#include "oracles/abi/engine.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// What detects a fault: the referee, the relations (fuzz/judge/relation.h), or both.
enum class FoundBy { referee, relations, both };

/// For each case, the engine's findings by key (reports/record/result.h).
std::vector<std::map<std::string, Finding>> findings_of(std::span<const Case> cases, const EnginePtr& engine,
                                                        FoundBy by = FoundBy::referee);

/// What detects the findings with this key.
FoundBy found_by(const std::string& key);

/// `engine` must outlive the result.
StillShows keeps_finding(const EnginePtr& engine, std::string key);

/// The key among `found` of the same fault: `key` itself, or one that differs in its last part only, the
/// magnitude of the error. A missed overlap of 1e-8 and one of half a body are one fault, of which only the
/// second can be defensible. Empty if there is none.
std::string key_of_fault(const std::map<std::string, Finding>& found, const std::string& key);

/// Like keeps_finding, for any key of the same fault.
StillShows keeps_fault(const EnginePtr& engine, const std::string& key);

}  // namespace touchstone::fuzz
