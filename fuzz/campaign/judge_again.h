// Judges a stored campaign again from the answers that it kept, without starting any engine.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "reports/record/result.h"

namespace touchstone::fuzz {

struct JudgedAgain {
  Json settings;  // of the campaign, as stored
  /// As the campaign recorded it, and as judged now; both of the engines asked for alone.
  CampaignResult before, after;
  /// Forms of cases that the relations of this version ask for, and answers found wrong now, that were not
  /// put to the engine, or not put again, then. They are not judged, or counted as stable.
  std::uint64_t not_kept_derived = 0, not_kept_again = 0;
};

/// Called after each chunk: cases judged so far, and all.
using JudgeProgress = std::function<void(std::uint64_t, std::uint64_t)>;

/// Reads state.json and answers.bin in `directory`, of a finished campaign or of one that can be resumed.
/// `engine`: the only one to judge (a name on a card); empty: all. Carried over from the stored result:
/// times, the last words of dying engines, and which engines were set aside. Throws InputError naming file,
/// place and reason; Stopped (worker_limits.h) when `stop` is set.
JudgedAgain judge_again(const std::filesystem::path& directory, const std::string& engine, int jobs,
                        const std::atomic<bool>& stop, const JudgeProgress& progress = {});

/// Writes the result as a campaign's directory, without answers. Throws InputError if `out` holds a campaign.
void save_judged_again(const std::filesystem::path& out, const JudgedAgain& judged);

}  // namespace touchstone::fuzz
