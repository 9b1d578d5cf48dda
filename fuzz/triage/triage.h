// Which findings of a run are new, which are known, and which known ones are gone.
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

/// A finding of a campaign as it lies in its directory.
struct StoredFinding {
  Finding finding;  // evidence empty
  Case c;
};
/// All of DIR/findings, by key. Throws InputError naming the file when one is damaged, or DIR holds no
/// campaign.
std::vector<StoredFinding> load_findings(const std::filesystem::path& campaign_directory);

/// The smallest case of a finding in the ledger. Throws InputError when it is damaged.
Case case_of(const KnownFinding& f);

/// One answer proves nothing: an engine may depend on load, or on what its memory held. A finding is gone
/// when its case does not show it this often in a row.
inline constexpr int asks_before_gone = 5;

struct TriageConfig {
  std::string date;  // ISO 8601, of this run
  /// Name and version of an engine's library; empty: the engine is not here.
  std::function<std::string(const std::string& engine)> build_of;
  /// Findings that the engine shows in a case, by key.
  std::function<std::map<std::string, Finding>(const std::string& engine, const Case& c)> ask;
  /// The smallest case that shows the key, c if it cannot be made smaller.
  std::function<Case(const std::string& engine, const std::string& key, const Case& c)> smallest;
};

/// Updates the ledger (commit it last: what is committed is not new any more) and says what became of each
/// finding, sorted by key. Gone ones of former runs are not mentioned again. One job for each of `jobs`,
/// which ask engines of their own; the result does not depend on how many.
std::vector<Triaged> triage(const std::vector<StoredFinding>& found, Ledger& ledger,
                            std::span<const TriageConfig> jobs);
inline std::vector<Triaged> triage(const std::vector<StoredFinding>& found, Ledger& ledger,
                                   const TriageConfig& config) {
  return triage(found, ledger, std::span<const TriageConfig>(&config, 1));
}

}  // namespace touchstone::fuzz
