// What a campaign keeps on disk, so that a killed run loses nothing already recorded:
//   DIR/state.json                 settings, the next chunk, and the result so far; replaced atomically
//   DIR/summary.json               the whole result, at the end
//   DIR/findings/<key>/case.json   the first case of a finding, ready for `touchstone replay`
//   DIR/findings/<key>/finding.json  words, answer, certificate, counts
#pragma once

#include <filesystem>
#include <optional>

#include "fuzz/ask/novelty.h"
#include "fuzz/campaign/campaign.h"

namespace touchstone::fuzz {

struct StoredState {
  std::uint64_t next_chunk = 0;
  bool finished = false;
  CampaignResult result;
  Pool pool;  // of a guided campaign
};

/// Throws InputError with the reason; one that is there is fine.
void make_directory(const std::filesystem::path& directory);

/// Renames a directory that holds a campaign to DIR.1, or the first such name that is free; false: it holds
/// none.
bool move_aside(const std::filesystem::path& out);

/// The state in config.out, or nothing when the directory is new. Throws InputError when it is finished,
/// damaged or made with other settings.
std::optional<StoredState> load_state(const CampaignConfig& config);
void save_state(const CampaignConfig& config, const StoredState& state);
/// With settings as they are in another state.
void save_state(const std::filesystem::path& out, const Json& settings, const StoredState& state);
void save_findings(const std::filesystem::path& out, const CampaignResult& result);

}  // namespace touchstone::fuzz
