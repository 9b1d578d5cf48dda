// A test case that lacks what it needs (data, an engine, a program) reports itself as skipped.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include "tests/support/catch.h"

namespace touchstone::test {

/// Names of the test cases that called `skip`.
inline std::set<std::string> skipped_cases;

/// Counts as an assertion, because a test case without any fails. Return from the test case afterwards.
inline void skip(const std::string& reason) {
  std::printf("skipped: %s\n", reason.c_str());
  skipped_cases.insert(std::string(Catch::getResultCapture().getCurrentTestName()));
  SUCCEED(reason);
}

/// Programs that this build does not link lack the runtime that its libraries then need.
#ifdef TS_ADDRESS_SANITIZER
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

inline bool has_command(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace touchstone::test
