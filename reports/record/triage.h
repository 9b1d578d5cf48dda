// The status of a run's findings: new, known, gone.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "reports/record/observation_json.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// A row of the ledger.
struct KnownFinding {
  std::string key, engine, question, fault, shapes, blame, degeneracy, magnitude;
  std::string first_seen, last_seen, first_build, last_build;
  std::uint64_t count = 0;
  CaseSize size;
  std::string smallest, words, expired;
  bool operator==(const KnownFinding&) const = default;
};

enum class Standing : std::uint8_t {
  fresh,     // not in the ledger until now
  known,     // in the ledger, seen in this run
  back,      // in the ledger as gone, seen again
  still,     // in the ledger, not seen in this run, but its case still shows it when repeated
  flaky,     // as still, but some repetitions did not show it
  gone,      // in the ledger, and no repetition of its case showed it: now expired
  not_asked  // in the ledger, but its engine is missing or could not be queried
};
inline constexpr auto standing_names =
    std::to_array<std::string_view>({"new", "known", "back", "still", "flaky", "gone", "not asked"});
static_assert(standing_names.size() == static_cast<std::size_t>(Standing::not_asked) + 1);
constexpr std::string_view to_string(Standing s) { return standing_names[static_cast<std::size_t>(s)]; }

struct Triaged {
  Standing standing = Standing::fresh;
  KnownFinding finding;      // as now in the ledger
  int asked = 0, shown = 0;  // if not seen in this run: repetitions of its case, and those that showed it
  std::string trouble;       // why it could not be shrunk or repeated; the others continue
};

/// Returns the smallest case of a finding in the ledger. Throws InputError when it is damaged.
Json case_json_of(const KnownFinding& f);

}  // namespace touchstone::fuzz
