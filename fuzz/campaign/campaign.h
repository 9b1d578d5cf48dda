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

#include "fuzz/record/result.h"
#include "oracles/api/engine.h"

namespace touchstone::fuzz {

struct CampaignConfig {
  std::vector<std::string> engines;  // catalog names, for the record
  std::string subject = "core";
  std::string family;  // empty: the default mix
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> cases;
  std::optional<double> minutes;
  int jobs = 1;
  std::uint64_t shard = 0, shards = 1;
  std::filesystem::path out;  // empty: nothing is written
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

/// Judges the answers of one case and adds them to the result. Used by campaigns and by replay.
void judge_into(CampaignResult& result, const Case& c, std::uint64_t index,
                std::span<const EnginePtr> engines, std::span<const CaseObservations> observations);

/// Asks every engine about all cases, then judges each case; case i is counted as index first_index + i.
void ask_and_judge(CampaignResult& result, std::span<const Case> cases, std::uint64_t first_index,
                   std::span<const EnginePtr> engines);

/// Runs to the end, to the time limit, or until `stop` is set (what is done is kept and can be resumed from
/// `out`). Throws InputError when `out` holds a finished campaign or one with other settings.
CampaignResult run_campaign(const CampaignConfig& config, const EngineFactory& engines,
                            const ProgressCallback& progress, const std::atomic<bool>& stop);

}  // namespace touchstone::fuzz
