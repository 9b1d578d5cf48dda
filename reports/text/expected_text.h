// How the failures of a run compare with the expected ones, for people and for continuous integration.
#pragma once

#include <string>

#include "reports/record/expected.h"

namespace touchstone::reports {

/// Lists what is newly wrong and what is fixed.
std::string expected_text(const fuzz::ExpectedComparison& c);

/// JUnit: one suite per engine and one test per question asked of a case. Newly wrong answers fail, and with
/// `strict` also those that are expected to be wrong and are right; expected failures are skipped.
std::string expected_junit(const fuzz::ShownFailures& shown, const fuzz::ExpectedComparison& c, bool strict);

}  // namespace touchstone::reports
