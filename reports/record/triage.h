// The standing of a run's causes: new, known, gone.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reports/record/causes.h"
#include "reports/record/observation_json.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// A row of the ledger.
struct KnownCause {
  std::string id, path, title, documented;   // as in Cause
  Severity severity = Severity::relation;    // the gravest seen
  std::vector<std::string> engines, shapes;  // all seen; each sorted, without repetitions
  std::string first_seen, last_seen, first_build, last_build;
  std::uint64_t count = 0;  // wrong answers
  /// The case to ask again, as JSON, with the engine that shows the cause in it, the finding's key there, and
  /// the fault in words. Empty: there is none.
  std::string engine, key, shown, words;
  CaseSize size;
  std::string expired;        // empty while the case shows the cause, else the date on which it first did not
  std::string reason, until;  // of its suppression, which lasts through that day; both empty: none
  bool operator==(const KnownCause&) const = default;
};

enum class Standing : std::uint8_t {
  fresh,      // not in the ledger until now
  back,       // in the ledger as gone, seen again
  changed,    // in the ledger, seen in this run with kinds of shapes not seen before
  known,      // in the ledger, seen in this run
  still,      // in the ledger, not seen in this run, but its case still shows it when asked again
  flaky,      // as still, but some repetitions did not show it
  gone,       // in the ledger, and no repetition of its case showed it: now expired
  not_asked,  // in the ledger, but it has no case, or its engine is missing or could not be asked
  suppressed  // any of the above except new and gone, and the ledger has a suppression that has not ended
};
inline constexpr auto standing_names = std::to_array<std::string_view>(
    {"new", "back", "changed", "known", "still", "flaky", "gone", "not asked", "suppressed"});
static_assert(standing_names.size() == static_cast<std::size_t>(Standing::suppressed) + 1);
constexpr std::string_view to_string(Standing s) { return standing_names[static_cast<std::size_t>(s)]; }

struct Triaged {
  Standing standing = Standing::fresh;
  KnownCause cause;                     // as now in the ledger
  std::vector<std::string> new_shapes;  // kinds of shapes of this run that the ledger did not have
  bool suppression_ended = false;       // it is shown, and its suppression was for an earlier date
  int asked = 0, shown = 0;  // if not seen in this run: repetitions of its case, and those that showed it
  std::string trouble;       // why it could not be asked; the others continue

  /// What makes a run fail. A known cause with more shapes does not: a random campaign finds some every
  /// night.
  bool counts() const {
    return standing == Standing::fresh || standing == Standing::back || suppression_ended;
  }
};

/// The case of a cause in the ledger. Throws InputError when it is damaged; null when there is none.
inline Json case_json_of(const KnownCause& k) {
  return k.shown.empty() ? Json() : parse_json(k.shown, "ledger, " + k.id);
}

}  // namespace touchstone::fuzz
