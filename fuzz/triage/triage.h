// Decides which causes of a run are new, which are known, and which known ones are gone.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "fuzz/triage/ledger.h"
#include "reports/record/causes.h"
#include "reports/record/result.h"
#include "reports/record/triage.h"

namespace touchstone::fuzz {

/// The case of a cause in the ledger, which must have one. Throws InputError when it is damaged.
Case case_of(const KnownCause& k);

/// A single answer proves nothing, because an engine may depend on load or on the previous contents of
/// memory. A cause is gone when its case fails to show it this many times in a row.
inline constexpr int asks_before_gone = 5;

/// Whether what an engine shows now is the fault of `key`: the same question and kind of fault. Everything
/// else in a key may change without the fault being repaired: the magnitude and the blame with any rounding,
/// the site of a crash with any line. The severity alone would be too little: a case that was answered late
/// and now early shows another fault, which the next campaign files under its own cause.
bool shows_again(const std::string& engine, const std::string& key,
                 const std::map<std::string, Finding>& found);

struct TriageConfig {
  std::string date;  // of this run, ISO 8601
  /// Returns name and version of an engine's library; empty if the engine is not available.
  std::function<std::string(const std::string& engine)> build_of;
  /// Returns the findings that the engine shows in a case, by key.
  std::function<std::map<std::string, Finding>(const std::string& engine, const Case& c)> ask;
};

/// Updates the ledger and returns the standing of each cause: those found, in their order, then the known
/// ones that were not found, by severity and id. Commit the ledger last: a committed cause is no longer new.
/// Causes that were gone in earlier runs are not reported again. Runs one job per element of `jobs`, each
/// with engines of its own; the result does not depend on their number. Throws InputError when two causes
/// have the same id.
std::vector<Triaged> triage(const std::vector<Cause>& found, Ledger& ledger,
                            std::span<const TriageConfig> jobs);
inline std::vector<Triaged> triage(const std::vector<Cause>& found, Ledger& ledger,
                                   const TriageConfig& config) {
  return triage(found, ledger, std::span<const TriageConfig>(&config, 1));
}

/// Records that the cause is not to count through the day `until` (ISO 8601). Throws InputError when the
/// ledger has no such cause, `reason` is blank, or `until` is not a date or is before `today`.
void suppress(Ledger& ledger, const std::string& id, const std::string& reason, const std::string& until,
              const std::string& today);
/// Throws InputError when the ledger has no such cause, or it is not suppressed.
void unsuppress(Ledger& ledger, const std::string& id);

}  // namespace touchstone::fuzz
