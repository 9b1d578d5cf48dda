// Case to engines to judgements to findings: the one place where a finding gets its identity.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "oracles/abi/engine.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// A case in all its derived forms costs an engine about fifteen times the case, and the referee nothing.
inline constexpr std::uint64_t default_relations_every = 16;

/// Judges the answers of one case and adds them to the result. Used by campaigns and by replay.
/// What was new about it is added to `features` when that is given.
void judge_into(CampaignResult& result, const Case& c, std::uint64_t index,
                std::span<const EnginePtr> engines, std::span<const CaseObservations> observations,
                std::vector<std::uint64_t>* features = nullptr);

/// Asks the engine about the cases derived from c by every relation, and adds what contradicts `base`.
void relate_into(CampaignResult& result, const Case& c, std::uint64_t index, const EnginePtr& engine,
                 const CaseObservations& base);

/// Asks every engine about all cases, then judges each case; case i is counted as index first_index + i.
/// Those whose index is a multiple of relations_every are asked under the relations too. `features`, when
/// given, gets one list a case.
void ask_and_judge(CampaignResult& result, std::span<const Case> cases, std::uint64_t first_index,
                   std::span<const EnginePtr> engines,
                   std::uint64_t relations_every = default_relations_every,
                   std::vector<std::vector<std::uint64_t>>* features = nullptr);

}  // namespace touchstone::fuzz
