// Which part of a campaign this process runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fuzz/campaign/campaign.h"

namespace touchstone::fuzz {

struct Shard {
  std::uint64_t index = 0, count = 1;  // 0 <= index < count
  std::string source;                  // option or variable that chose it, for messages
};

/// Returns the value of an environment variable, or nothing when it is not set.
using Variable = std::function<std::optional<std::string>(const char* name)>;

/// `text` is "i/n". If it is empty, the shard is that of a Slurm array task (SLURM_ARRAY_TASK_ID, _COUNT,
/// _MIN, _STEP) or of an indexed Kubernetes job (JOB_COMPLETION_INDEX, and JOB_COMPLETIONS, which the job's
/// template must set); without either, the whole campaign. Throws InputError naming what is missing or out of
/// range.
Shard which_shard(const std::string& text, const Variable& variable);

// Merges the shards of one campaign into what an unsharded run would have written. The order of the shards
// does not matter, nor does a shard that is given more than once.

struct Merged {
  CampaignResult result;
  std::vector<std::uint64_t> shards, missing;  // sorted
};

/// Reads the campaigns in `in` and writes their union to `out`: state.json, summary.json, findings/.
/// If no shard is missing, the result equals an unsharded run except for times. Throws InputError when an
/// input is not a finished campaign, settings differ, one shard has two different results, two parts share
/// some shards but not all, or `out` already holds a campaign.
Merged merge_campaigns(const std::filesystem::path& out, std::span<const std::filesystem::path> in);

}  // namespace touchstone::fuzz
