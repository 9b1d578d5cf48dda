// Decides which findings of a run are new, which are known, and which known ones are gone.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/triage/ledger.h"
#include "reports/record/result.h"
#include "reports/record/triage.h"

namespace touchstone::fuzz {

/// A finding as stored in a campaign's directory.
struct StoredFinding {
  Finding finding;  // evidence empty
  Case c;
};
/// Loads DIR/findings, sorted by key. Throws InputError naming the file when one is damaged, or when DIR does
/// not hold a campaign.
std::vector<StoredFinding> load_findings(const std::filesystem::path& campaign_directory);

/// Returns the smallest case of a finding in the ledger. Throws InputError when it is damaged.
Case case_of(const KnownFinding& f);

/// A single answer proves nothing, because an engine may depend on load or on the previous contents of
/// memory. A finding is gone when its case fails to show it this many times in a row.
inline constexpr int asks_before_gone = 5;

struct TriageConfig {
  std::string date;  // of this run, ISO 8601
  /// Returns name and version of an engine's library; empty if the engine is not available.
  std::function<std::string(const std::string& engine)> build_of;
  /// Returns the findings that the engine shows in a case, by key.
  std::function<std::map<std::string, Finding>(const std::string& engine, const Case& c)> ask;
  /// Returns the smallest case that shows the key, or c if it cannot be made smaller.
  std::function<Case(const std::string& engine, const std::string& key, const Case& c)> smallest;
};

/// Updates the ledger and returns the status of each finding, sorted by key. Commit the ledger last: a
/// committed finding is no longer new. Findings that were gone in earlier runs are not reported again. Runs
/// one job per element of `jobs`, each with engines of its own; the result does not depend on their number.
std::vector<Triaged> triage(const std::vector<StoredFinding>& found, Ledger& ledger,
                            std::span<const TriageConfig> jobs);
inline std::vector<Triaged> triage(const std::vector<StoredFinding>& found, Ledger& ledger,
                                   const TriageConfig& config) {
  return triage(found, ledger, std::span<const TriageConfig>(&config, 1));
}

}  // namespace touchstone::fuzz
