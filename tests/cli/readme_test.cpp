// Every command line of the README runs. `./touchstone` is replaced by the program itself (its launcher would
// build it again), `test` is left out (it runs this test), minutes are shortened, and ./libmine.so is
// replaced by the example plug-in.
#include <sys/wait.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/catch.h"

namespace fs = std::filesystem;

namespace {

std::vector<std::string> readme_commands() {
  std::ifstream in(TS_SOURCE_DIR "/README.md");
  std::vector<std::string> commands;
  bool shell = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```"))
      shell = line == "```sh";
    else if (shell && line.starts_with("./touchstone"))
      commands.push_back(line);
  }
  return commands;
}

std::string for_test(std::string c) {
  c = std::regex_replace(c, std::regex(R"(^\./touchstone)"), TS_BINARY_DIR "/bin/touchstone");
  c = std::regex_replace(c, std::regex("--minutes 1"), "--minutes 0.05");
  c = std::regex_replace(c, std::regex("--cases [0-9]+"), "--cases 300");
  c = std::regex_replace(c, std::regex(R"(\$\(date \+%Y%m%d\))"), "20261121");  // the same cases on every day
  c = std::regex_replace(c, std::regex(R"(\./libmine\.so)"), TS_BINARY_DIR "/lib/libtouchstone_example.so");
  c = std::regex_replace(c, std::regex("-o broad.html"), "-o " TS_BINARY_DIR "/readme-broad.html");
  c = std::regex_replace(c, std::regex("-o reproduce.cpp"), "-o " TS_BINARY_DIR "/readme-reproduce.cpp");
  if (c.find(" view ") != std::string::npos && c.find("--broad") == std::string::npos &&
      !fs::exists(TS_BINARY_DIR "/share/touchstone/web/case.html"))
    c = std::regex_replace(c, std::regex("-o page.html"), "--json");  // pages are built only with Node
  c = std::regex_replace(c, std::regex("-o page.html"), "-o " TS_BINARY_DIR "/readme-page.html");
  // With all engines each takes a minute; the core is enough to show that the line works.
  if (c.find(" chart ") != std::string::npos) c += " --engines core --broad grid --measure 0";
  if (c.find(" stability ") != std::string::npos) c += " --engines core --ladder gap";
  c = std::regex_replace(c, std::regex("out/(chart|stability)"), TS_BINARY_DIR "/readme-$1");
  c = std::regex_replace(c, std::regex("out/grid"), TS_BINARY_DIR "/readme-grid");
  if (c.find("certify --subject") != std::string::npos) c += " --limit 100";
  c = std::regex_replace(c, std::regex("out/nightly"), TS_BINARY_DIR "/readme-out");
  c = std::regex_replace(c, std::regex("out/(part|merged|kept)"), TS_BINARY_DIR "/readme-shards/$1");
  if (c.find(" fuzz ") != std::string::npos && c.find(" --out ") == std::string::npos)
    c += " --out " TS_BINARY_DIR "/readme-out";
  if (c.find(" triage ") != std::string::npos) c += " --ledger " TS_BINARY_DIR "/readme-out/findings.db";
  return c;
}

}  // namespace

TEST_CASE("every command line of the README runs", "[readme]") {
  std::size_t run = 0;
  fs::remove_all(TS_BINARY_DIR "/readme-shards");
  for (const std::string& line : readme_commands()) {
    if (line == "./touchstone test") continue;
    if (line.find(" fuzz ") != std::string::npos) fs::remove_all(TS_BINARY_DIR "/readme-out");
    const std::string command = "cd " TS_SOURCE_DIR " && " + for_test(line) + " >/dev/null </dev/null";
    const int status = std::system(command.c_str());
    INFO(line);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    ++run;
  }
  fs::remove_all(TS_BINARY_DIR "/readme-out");
  fs::remove_all(TS_BINARY_DIR "/readme-shards");
  CHECK(run >= 6);
}
