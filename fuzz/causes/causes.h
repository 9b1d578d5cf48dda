// From the findings of a campaign to the distinct causes behind them: fold, reduce, intervene, group, name
// and order (reports/record/causes.h).
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "fuzz/causes/classes.h"
#include "fuzz/causes/engine_pool.h"
#include "fuzz/causes/examinations.h"
#include "fuzz/causes/group.h"
#include "fuzz/causes/representative.h"
#include "reports/record/causes.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

struct CausesConfig {
  EngineKnowledge knowledge;
  MakeEngine make;
  /// A program in the engine's own API that shows a finding, which has its evidence. Throws InputError with
  /// the reason when there is none. May be empty.
  std::function<std::string(const Finding& finding, const EngineCard& card)> program;
  int jobs = 1;
  std::size_t representatives = 3;  // of a class
  std::size_t tries = 400;          // questions put to reduce one case
  std::optional<double> minutes;    // from then on, no further representative is examined
  const std::atomic<bool>* stop = nullptr;
  /// Examinations of earlier, not asked again; those of now are added. May be null.
  Examinations* examinations = nullptr;
  std::function<void(std::size_t done, std::size_t of)> progress;
  /// Given the causes before engines are asked about each other's cases (told_apart); for measurements.
  std::function<void(const Causes&)> before_cross_asking;
};

/// The causes of all findings, from what is stored alone: nothing is asked, so that one cause listed may be
/// several, and the other way round.
Causes causes_at_once(const CampaignResult& result, const EngineKnowledge& knowledge);

/// Asks the engines, reduces cases, and tells causes apart by their responses. The same result for any number
/// of jobs, unless the time is up.
Causes causes_of(const CampaignResult& result, const CausesConfig& config);

/// A part of causes_of: the representatives of all classes, examined.
std::vector<Representative> examined(const std::vector<FindingClass>& classes, const CausesConfig& config);

/// Asks the engine about both cases of the representative and fills in shown, smallest, certificate and
/// program. Leaves out what the engine no longer shows.
void add_evidence(Cause& cause, const Representative& r, const CausesConfig& config, EnginePool& pool);

/// The documented ones last; then by severity; of equal severity, most unlike first: after the most frequent,
/// always the one whose nearest predecessor of that severity is farthest (furthest point first; Chen et al.,
/// "Taming compiler fuzzers", PLDI 2013, §3). `distance` is between indices. Returns the indices in order.
std::vector<std::size_t> reading_order(const std::vector<Cause>& causes,
                                       const std::function<double(std::size_t, std::size_t)>& distance);

}  // namespace touchstone::fuzz
