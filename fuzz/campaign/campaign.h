// A differential campaign: makes cases, asks every engine, judges every answer, keeps what is wrong. Same
// seed and flags, same findings and counts, whatever the number of jobs; times are kept apart.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/ask/ask.h"
#include "oracles/abi/engine.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

struct CampaignConfig {
  std::vector<std::string> engines;  // catalog names, for the record
  std::string subject = "core";
  std::string family;  // one, several (`a,b`), or empty: the default mix
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> cases;
  std::optional<double> minutes;
  int jobs = 1;
  std::uint64_t shard = 0, shards = 1;
  std::filesystem::path out;  // empty: nothing is written
  bool fresh = false;         // a campaign that is in `out` is moved aside, not resumed
  /// Every so many cases one is also asked in the forms that the relations derive from it; 0: none.
  std::uint64_t relations_every = default_relations_every;
  /// Half of the cases are changed forms of earlier ones that made an engine do something new (novelty.h).
  bool guided = false;
  std::string error;  // the user's own tolerance (--error); empty: what the engines claim
};

/// Makes the engines of one job, in the order of CampaignConfig::engines.
using EngineFactory = std::function<std::vector<EnginePtr>()>;

struct Progress {
  const CampaignResult& result;
  double elapsed_s;
  double cases_per_s;
  std::optional<double> left_s;
  bool last;
};
using ProgressCallback = std::function<void(const Progress&)>;

/// Runs to the end, to the time limit, or until `stop` is set (what is done is kept and can be resumed from
/// `out`). Throws InputError when `out` holds a finished campaign or one with other settings.
CampaignResult run_campaign(const CampaignConfig& config, const EngineFactory& engines,
                            const ProgressCallback& progress, const std::atomic<bool>& stop);

}  // namespace touchstone::fuzz
