// JUnit XML, which continuous integration reads: suites of tests that pass, fail or are skipped.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reports/record/expected.h"

namespace touchstone::reports {

enum class TestResult : std::uint8_t { passed, failed, skipped };

struct JUnitTest {
  std::string suite, name;
  TestResult result = TestResult::passed;
  std::string message;  // why it failed or was skipped
  std::string text;     // of a failure: all that is known
};

/// The suites sorted by name, each with its tests in their order.
std::string junit(const std::vector<JUnitTest>& tests);

/// Lists what is newly wrong and what is fixed.
std::string expected_text(const fuzz::ExpectedComparison& c);

/// JUnit: one suite per engine and one test per question asked of a case. Newly wrong answers fail, and with
/// `strict` also those that are expected to be wrong and are right; expected failures are skipped.
std::string expected_junit(const fuzz::ShownFailures& shown, const fuzz::ExpectedComparison& c, bool strict);

}  // namespace touchstone::reports
