// From case to engines to judgements to findings: the only place where a finding gets its identity.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "oracles/abi/engine.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// A case in all its derived forms costs an engine about seventeen times the case itself, and the referee
/// nothing.
inline constexpr std::uint64_t default_relations_every = 16;

/// Judges the answers to one case and adds them to the result. Used by campaigns and by replay. If `features`
/// is given, the features of the case are added to it.
void judge_into(CampaignResult& result, const Case& c, std::uint64_t index,
                std::span<const EnginePtr> engines, std::span<const CaseObservations> observations,
                std::vector<std::uint64_t>* features = nullptr);

/// Runs the engine on the cases derived from c by every relation, and adds what contradicts `base` to the
/// result.
void relate_into(CampaignResult& result, const Case& c, std::uint64_t index, const EnginePtr& engine,
                 const CaseObservations& base);

/// Runs every engine on all cases, then judges each case; case i counts as index first_index + i. Cases whose
/// index is a multiple of relations_every are also run under the relations. `features`, if given, receives
/// one list per case.
void ask_and_judge(CampaignResult& result, std::span<const Case> cases, std::uint64_t first_index,
                   std::span<const EnginePtr> engines,
                   std::uint64_t relations_every = default_relations_every,
                   std::vector<std::vector<std::uint64_t>>* features = nullptr);

}  // namespace touchstone::fuzz
