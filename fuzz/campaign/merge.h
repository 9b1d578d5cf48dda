// Merges the shards of one campaign into what an unsharded run would have written. The order of the shards
// does not matter, nor does a shard that is given more than once.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "fuzz/campaign/campaign.h"

namespace touchstone::fuzz {

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
