// Shards of one campaign into one: what an unsharded run would have left, whatever the order of the shards
// and however often one is given.
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
/// Complete, it equals an unsharded run but for times. Throws InputError: no finished campaign, other
/// settings, two different results of one shard, two parts that share some shards and not others, or `out`
/// exists.
Merged merge_campaigns(const std::filesystem::path& out, std::span<const std::filesystem::path> in);

}  // namespace touchstone::fuzz
