#include "reports/text/junit.h"

#include <fmt/format.h>

#include <map>

namespace touchstone::reports {
namespace {

std::string escaped(const std::string& s) {
  std::string r;
  for (const char c : s) {
    if (c == '&')
      r += "&amp;";
    else if (c == '<')
      r += "&lt;";
    else if (c == '>')
      r += "&gt;";
    else if (c == '"')
      r += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n')
      r += c;
    else
      r += ' ';
  }
  return r;
}

std::string element(const JUnitTest& t) {
  std::string r = fmt::format("  <testcase classname=\"{}\" name=\"{}\">", escaped(t.suite), escaped(t.name));
  if (t.result == TestResult::failed)
    r += fmt::format("<failure message=\"{}\">{}</failure>", escaped(t.message), escaped(t.text));
  if (t.result == TestResult::skipped) r += fmt::format("<skipped message=\"{}\"/>", escaped(t.message));
  return r + "</testcase>\n";
}

}  // namespace

std::string junit(const std::vector<JUnitTest>& tests) {
  std::map<std::string, std::vector<const JUnitTest*>> suites;
  for (const JUnitTest& t : tests) suites[t.suite].push_back(&t);
  std::string r = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"touchstone\">\n";
  for (const auto& [suite, of_suite] : suites) {
    std::size_t failures = 0, skipped = 0;
    for (const JUnitTest* t : of_suite) {
      failures += t->result == TestResult::failed;
      skipped += t->result == TestResult::skipped;
    }
    r += fmt::format(" <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" errors=\"0\">\n",
                     escaped(suite), of_suite.size(), failures, skipped);
    for (const JUnitTest* t : of_suite) r += element(*t);
    r += " </testsuite>\n";
  }
  return r + "</testsuites>\n";
}

}  // namespace touchstone::reports
