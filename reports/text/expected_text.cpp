#include "reports/text/junit.h"

#include <fmt/format.h>

#include <map>

#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::AskedQuestion;

std::string headline(const AskedQuestion& a, const std::string& fault) {
  return fmt::format("  {}: {} {} {}\n", a.case_id, a.engine, a.question, fault);
}

std::string indented(const std::string& words) {
  return words.empty() ? "" : fmt::format("    {}\n", wrapped(words, 76, 4));
}

void fail(JUnitTest& t, const std::string& message, const std::string& text) {
  const bool is_first = t.result != TestResult::failed;
  t.result = TestResult::failed;
  t.message = is_first ? message : t.message + ", " + message;
  t.text += (is_first ? "" : "\n") + text;
}

}  // namespace

std::string expected_text(const fuzz::ExpectedComparison& c) {
  std::string r;
  if (!c.newly_wrong.empty()) r += "newly wrong:\n";
  for (const auto& newly : c.newly_wrong)
    r += headline(newly.failure.asked, newly.failure.fault) + indented(newly.failure.words) +
         indented(newly.why);
  if (!c.fixed.empty()) r += "fixed (their entries can be removed):\n";
  for (const auto& e : c.fixed) r += headline(e.asked, e.fault) + indented(e.reason);
  return r;
}

std::string expected_junit(const fuzz::ShownFailures& shown, const fuzz::ExpectedComparison& c, bool strict) {
  std::map<AskedQuestion, JUnitTest> tests;
  for (const AskedQuestion& a : shown.answered)
    tests[a] = {a.engine, a.case_id + " " + a.question, TestResult::passed, "", ""};
  for (const auto& filed : c.as_expected) {
    JUnitTest& t = tests[filed.failure.asked];
    t.result = TestResult::skipped;
    t.message = fmt::format("{} as expected: {}", filed.failure.fault, filed.why);
  }
  if (strict)
    for (const auto& e : c.fixed)
      fail(tests[e.asked], "fixed: " + e.fault, "it was expected to be wrong: " + e.reason);
  for (const auto& newly : c.newly_wrong)
    fail(tests[newly.failure.asked], "newly wrong: " + newly.failure.fault,
         newly.failure.words + (newly.why.empty() ? "" : "\n" + newly.why));
  std::vector<JUnitTest> all;
  for (const auto& [asked, test] : tests) all.push_back(test);
  return junit(all);
}

}  // namespace touchstone::reports
