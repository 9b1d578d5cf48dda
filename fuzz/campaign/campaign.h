// A differential campaign: generates cases, queries every engine, judges every answer and keeps the findings.
// The same seed and flags give the same findings and counts for any number of jobs; times are stored
// separately.
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
  std::vector<std::string> engines;  // catalog names, as recorded
  std::string subject = "core";
  std::string family;  // one name, several (`a,b`), or empty for the default mix
  /// The kinds of shapes of which cases are made, if the subject's card lists them; empty: all.
  std::vector<ShapeKind> kinds = {};
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> cases;
  std::optional<double> minutes;
  int jobs = 1;
  std::uint64_t shard = 0, shards = 1;
  std::filesystem::path out;  // if empty, nothing is written
  bool fresh = false;         // move a campaign found in `out` aside instead of resuming it
  /// One case in `relations_every` is also run in the forms derived by the relations; 0: none.
  std::uint64_t relations_every = default_relations_every;
  /// Half of the cases are mutations of earlier ones that made an engine do something new (novelty.h).
  bool guided = false;
  std::string error;  // the user's tolerance (--error); empty: the engines' own claims
  /// Keep every case and every answer in `out` (answers_file.h), so that they can be judged again.
  bool keep_answers = false;
  /// Make the certificate of every finding, in exact arithmetic; otherwise those that take long are deferred
  /// (fuzz/ask/evidence.h) until somebody checks them.
  bool certificates = false;
};

/// Creates the engines of one job, in the order of CampaignConfig::engines.
using EngineFactory = std::function<std::vector<EnginePtr>()>;

struct Progress {
  const CampaignResult& result;
  double elapsed_s;
  double cases_per_s;
  std::optional<double> left_s;
  bool last;
};
using ProgressCallback = std::function<void(const Progress&)>;

/// Runs to the end, to the time limit, or until `stop` is set (the work done so far is kept and can be
/// resumed from `out`). Throws InputError when `out` holds a finished campaign or one with different
/// settings.
CampaignResult run_campaign(const CampaignConfig& config, const EngineFactory& engines,
                            const ProgressCallback& progress, const std::atomic<bool>& stop);

}  // namespace touchstone::fuzz
