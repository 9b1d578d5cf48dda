// The files of a campaign. A run that is killed loses nothing that was already recorded:
//   DIR/state.json                 settings, the next chunk, and the result so far with the cases of all
//                                  examples; replaced atomically
//   DIR/summary.json               the whole result, at the end
//   DIR/findings/<key>/case.json   the first case of a finding, ready for `touchstone replay`
//   DIR/findings/<key>/finding.json  message, answer, certificate (it may be deferred: fuzz/ask/evidence.h),
//                                  counts, examples without their cases
//   DIR/answers.bin                every case and answer (answers_file.h), if the campaign keeps them;
//   appended
//                                  to, and cut to the length in state.json when the campaign is resumed
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
  Pool pool;                        // guided campaigns only
  std::uint64_t answers_bytes = 0;  // of answers.bin, if answers are kept
};

/// Succeeds if the directory already exists. Throws InputError with the reason.
void make_directory(const std::filesystem::path& directory);

/// Renames a directory that holds a campaign to DIR.1, or to the first such name that is free. Returns false
/// if it does not hold one.
bool move_aside(const std::filesystem::path& out);

/// Returns the state in config.out, or nothing when the directory is new. Throws InputError when the campaign
/// is finished, damaged or has different settings.
std::optional<StoredState> load_state(const CampaignConfig& config);
void save_state(const CampaignConfig& config, const StoredState& state);
/// The same with settings taken from another state.
void save_state(const std::filesystem::path& out, const Json& settings, const StoredState& state);
/// Throws InputError when the directory holds no campaign.
void require_campaign(const std::filesystem::path& directory);
/// The contents of DIR/state.json. Throws InputError when the directory holds no campaign.
Json load_state_json(const std::filesystem::path& directory);
/// The result in DIR/state.json, of a finished campaign or so far, with evidence and examples and their
/// cases. Throws InputError when the directory holds no campaign, or a damaged one.
CampaignResult load_result(const std::filesystem::path& directory);
/// The settings in DIR/state.json: "seed" is a whole number, "family" a text, "engines" a list of texts; the
/// others are as stored. An engine may be a plug-in's path or a command, which a file must not choose:
/// compare it with what the command line gives, never run it. Throws InputError likewise.
Json load_settings(const std::filesystem::path& directory);
void save_findings(const std::filesystem::path& out, const CampaignResult& result);

}  // namespace touchstone::fuzz
