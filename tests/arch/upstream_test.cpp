// The reports in docs/upstream: their checks of the truth hold, and their programs print what the reports
// say.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using touchstone::test::has_command;
using touchstone::test::read_all;
using touchstone::test::Run;
using touchstone::test::Workspace;
namespace fs = std::filesystem;

namespace {

constexpr const char* folder = TS_SOURCE_DIR "/docs/upstream";

std::vector<fs::path> reports() {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != "README.md") all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

// The only block of this language; fails if there is another number of them.
std::string block(const fs::path& report, const std::string& language) {
  std::ifstream in(report);
  std::string text;
  std::size_t found = 0;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = line == "```" + language;
      found += inside ? 1 : 0;
    } else if (inside) {
      text += line + "\n";
    }
  }
  INFO(report << ": blocks of " << language);
  REQUIRE(found == 1);
  return text;
}

// "package `libfcl-dev` 0.7.0-3+b1" in the first paragraph.
bool is_installed_as_reported(const Workspace& w, const fs::path& report) {
  static const std::regex package("package `([^`]+)` ([^ ,)]+)");
  const std::string text = read_all(report);
  std::smatch m;
  INFO(report);
  REQUIRE(std::regex_search(text, m, package));
  return w.run("dpkg-query -W -f '${Version}' " + m[1].str()).out == m[2].str();
}

}  // namespace

TEST_CASE("reports for maintainers have all parts and are listed", "[upstream]") {
  const std::string list = read_all(fs::path(folder) / "README.md");
  for (const fs::path& report : reports()) {
    const std::string text = read_all(report);
    INFO(report);
    std::size_t at = 0;
    for (const char* heading : {"# ", "## Program", "## Actual output", "## Expected",
                                "## Why this is certain", "## Where", "## Proposed fix"}) {
      INFO(heading);
      at = text.find(std::string(heading), at);
      REQUIRE(at != std::string::npos);
    }
    CHECK(block(report, "diff").find("\n@@ ") != std::string::npos);
    CHECK(list.find("(" + report.filename().string() + ")") != std::string::npos);
  }
  CHECK(reports().size() == 10);
}

TEST_CASE("the checks of the truth in reports for maintainers hold", "[upstream][optional]") {
  if (!has_command("python3")) return touchstone::test::skip("python3 is not installed");
  const Workspace w("upstream-truth");
  for (const fs::path& report : reports()) {
    const std::string check = block(report, "python");
    CHECK(check.find("assert ") != std::string::npos);
    const Run r = w.run("python3 " + w.write("check.py", check).string());
    INFO(report << "\n" << r.err);
    CHECK(r.code == 0);
  }
}

TEST_CASE("programs in reports for maintainers print what the reports say", "[upstream][optional]") {
  if (!has_command("g++") || !has_command("dpkg-query"))
    return touchstone::test::skip("g++ or dpkg-query is not installed");
  const Workspace w("upstream-programs");
  std::size_t compared = 0;
  for (const fs::path& report : reports()) {
    if (!is_installed_as_reported(w, report)) continue;
    w.write(report.stem().string() + ".cpp", block(report, "cpp"));
    const Run r = w.run(block(report, "sh"));
    INFO(report << "\n" << r.err);
    CHECK(r.code == 0);
    CHECK(r.out == block(report, "text"));
    ++compared;
  }
  if (compared == 0) touchstone::test::skip("no engine is installed in the version of its reports");
}
