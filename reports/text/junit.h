// JUnit XML, which continuous integration reads: suites of tests that pass, fail or are skipped.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

}  // namespace touchstone::reports
