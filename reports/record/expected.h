// Failures that are known and accepted for now, for continuous integration: a file of them, and how the
// failures of a run compare with it.
//
//   {"touchstone_expected": 1, "failures": [{"case": "corpus/…", "engine": "fcl-libccd", "question":
//   "contact",
//     "fault": "infeasible", "reason": "issue #12", "until": "2026-12-31"}]}
#pragma once

#include <compare>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "reports/record/observation_json.h"
#include "scenarios/codec/json_reader.h"

namespace touchstone::fuzz {

/// An engine's answer to one question of a case. The case by its id; cases of the same id count as one.
struct AskedQuestion {
  std::string case_id, engine, question;
  auto operator<=>(const AskedQuestion&) const = default;
};

/// An answer that is wrong. `fault` is a kind of fault (fault_kind.h).
struct Failure {
  AskedQuestion asked;
  std::string fault, words;
};

/// One entry of the file.
struct ExpectedFailure {
  AskedQuestion asked;
  std::string fault;   // or any_fault
  std::string reason;  // why it is accepted
  std::string until;   // the last day on which it is expected, ISO 8601; empty: no end
  auto operator<=>(const ExpectedFailure&) const = default;
};
inline constexpr const char* any_fault = "any";

/// Throws InputError, naming file and place: also when an entry has no reason, or is there twice.
std::vector<ExpectedFailure> expected_from_json(const JsonReader& j);
/// Sorted.
Json to_json(std::vector<ExpectedFailure> expected);

/// What a run showed.
struct ShownFailures {
  std::set<AskedQuestion> answered;  // questions that were answered or failed
  std::vector<Failure> failures;     // of those
};

struct ExpectedComparison {
  struct Filed {
    Failure failure;
    /// As expected: the entry's reason. Newly wrong: the entry that covered it until an earlier date, in
    /// words; empty: there is none.
    std::string why;
  };
  std::vector<Filed> as_expected, newly_wrong;
  std::vector<ExpectedFailure> fixed;      // answered, and the failure was not shown
  std::vector<ExpectedFailure> not_asked;  // the run did not ask, or the engine does not answer
};
/// `today` as ISO 8601. Everything sorted; a failure shown several times is listed once.
ExpectedComparison compare(const std::vector<ExpectedFailure>& expected, const ShownFailures& shown,
                           const std::string& today);

/// The file that expects exactly what the run showed: entries that still hold, or that the run says nothing
/// about, stay with their reasons; fixed ones go; newly wrong answers are added with `reason`.
std::vector<ExpectedFailure> as_shown(const std::vector<ExpectedFailure>& expected,
                                      const ExpectedComparison& compared, const std::string& reason);

/// "12 wrong as expected, 1 fixed, 0 newly wrong, 3 not asked".
std::string summary_of(const ExpectedComparison& c);
Json to_json(const ExpectedComparison& c);

}  // namespace touchstone::fuzz
