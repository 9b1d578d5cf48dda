// Every command line of the README and of the pages in docs/ runs. Lines that start with `./touchstone` are
// run in the checkout: it is replaced by the program itself (its launcher would build it again), `test` is
// left out (it runs this test), minutes are shortened, and ./libmine.so and ./libmybroad.so are replaced by
// the example plug-ins. Engines from npm come from a folder of packages that imitate them (npm_registry.h).
// The lines of guides, which start with another path to the program, are run in order in a directory of their
// own, with a stand-in for Box3D.
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/npm_registry.h"
#include "tests/support/python.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using touchstone::test::has_command;
using touchstone::test::NpmRegistry;
using touchstone::test::read_all;
using touchstone::test::Run;
using touchstone::test::two_small_balls;
using touchstone::test::Workspace;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> pages() {
  std::vector<fs::path> all{TS_SOURCE_DIR "/corpus/README.md"};
  for (const auto& entry : fs::directory_iterator(TS_SOURCE_DIR "/docs"))
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<std::string> commands_in_checkout(const fs::path& page) {
  std::ifstream in(page);
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

// Each once, in the order of the README and then of the pages.
std::vector<std::string> all_commands_in_checkout() {
  std::vector<std::string> all = commands_in_checkout(TS_SOURCE_DIR "/README.md");
  for (const fs::path& page : pages())
    for (const std::string& line : commands_in_checkout(page))
      if (std::find(all.begin(), all.end(), line) == all.end()) all.push_back(line);
  return all;
}

bool is_about_npm(const std::string& c) { return c.find("rapier") != std::string::npos; }

// Without Node there are no pages, and nothing is left of the command.
bool is_about_pages_alone(const std::string& c) { return c.starts_with("./touchstone open "); }

// With the releases of the packages that imitate Rapier, and a case that they get wrong.
std::string with_registry(std::string c, const Workspace& w, const NpmRegistry& npm) {
  c = std::regex_replace(c, std::regex("rapier@0.19,rapier@0.21"), "rapier@0.3,rapier@0.5");
  c = std::regex_replace(c, std::regex("--bad 0.19"), "--bad 0.6.0");
  c = std::regex_replace(c, std::regex("teleport_there_and_back"),
                         w.write("balls.json", two_small_balls).string());
  if (c.find(" versions ") != std::string::npos) c += " --releases 3 --cases 20";
  return npm.environment() + " " + c;
}

std::string for_test(std::string c) {
  c = std::regex_replace(c, std::regex(R"(^\./touchstone)"), TS_BINARY_DIR "/bin/touchstone");
  c = std::regex_replace(c, std::regex("--minutes 1"), "--minutes 0.05");
  c = std::regex_replace(c, std::regex("--cases [0-9]+"), "--cases 300");
  c = std::regex_replace(c, std::regex(R"(\$\(date \+%Y%m%d\))"), "20261121");  // the same cases on every day
  c = std::regex_replace(c, std::regex(R"(\./libmine\.so)"), TS_BINARY_DIR "/lib/libtouchstone_example.so");
  c = std::regex_replace(c, std::regex(R"(\./libmybroad\.so)"),
                         TS_BINARY_DIR "/lib/libtouchstone_example_broad.so");
  c = std::regex_replace(c, std::regex("-o reproduce.cpp"), "-o " TS_BINARY_DIR "/readme-reproduce.cpp");
  if (c.find(" view ") != std::string::npos && !fs::exists(TS_BINARY_DIR "/share/touchstone/web/case.html"))
    c = std::regex_replace(c, std::regex("-o (page|broad).html"),
                           "--json");  // pages are built only with Node
  c = std::regex_replace(c, std::regex("-o (page|broad).html"), "-o " TS_BINARY_DIR "/readme-$1.html");
  // With all engines each takes a minute; the core is enough to show that the line works.
  if (c.find(" chart ") != std::string::npos) c += " --engines core --broad grid --measure 0";
  if (c.find(" stability ") != std::string::npos) {
    c = std::regex_replace(c, std::regex(" --engines [^ ]+"), "") + " --engines core";
    if (c.find(" --motion") == std::string::npos) c += " --ladder gap";
  }
  c = std::regex_replace(c, std::regex("out/(chart|stability|motions)"), TS_BINARY_DIR "/readme-$1");
  if (c.find(" fingerprint ") != std::string::npos) c += " --cases 300";
  if (c.find("certify --subject") != std::string::npos) c += " --limit 100";
  // The causes of all engines take minutes.
  if (c.find("out/nightly") != std::string::npos && c.find(" fuzz ") != std::string::npos)
    c += " --engines core,ode";
  c = std::regex_replace(c, std::regex("out/(nightly|causes)"), TS_BINARY_DIR "/readme-out");
  if (!fs::exists(TS_BINARY_DIR "/share/touchstone/web/causes.html"))
    c = std::regex_replace(c, std::regex(" --page [^ ]+"), "");  // pages are built only with Node
  c = std::regex_replace(c, std::regex("expected.json"), TS_BINARY_DIR "/readme-expected.json");
  c = std::regex_replace(c, std::regex("out/(part|merged|kept)"), TS_BINARY_DIR "/readme-shards/$1");
  c = std::regex_replace(c, std::regex(" out/"), " " TS_BINARY_DIR "/readme-new/");
  if (c.find(" fuzz ") != std::string::npos && c.find(" --out ") == std::string::npos)
    c += " --out " TS_BINARY_DIR "/readme-out";
  if (c.find(" triage ") != std::string::npos) c += " --ledger " TS_BINARY_DIR "/readme-out/causes.db";
  return c;
}

// A guide's fenced block. `before`: the last line of text above it.
struct Block {
  std::string language, text, before;
};

std::vector<Block> blocks_of(const fs::path& guide) {
  std::vector<Block> blocks;
  std::ifstream in(guide);
  std::string before;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) blocks.push_back({line.substr(3), "", before});
      before.clear();
    } else if (inside) {
      blocks.back().text += line + "\n";
    } else if (!line.empty()) {
      before = line;
    }
  }
  return blocks;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// The line with the paths of this build, and with fewer cases.
std::string in_workspace(const Workspace& w, std::string line) {
  line = std::regex_replace(line, std::regex("build/release"), TS_BINARY_DIR);
  line = std::regex_replace(line, std::regex("PREFIX(?!_)"), (w.dir / "prefix").string());
  line = std::regex_replace(line, std::regex("SOURCE_DIR"), TS_SOURCE_DIR);
  line = std::regex_replace(line, std::regex("/opt/box3d"), TS_SOURCE_DIR "/tests/oracles/stubs/box3d");
  line = std::regex_replace(line, std::regex("~/"), w.dir.string() + "/");
  line = std::regex_replace(line, std::regex("--cases [0-9]+"), "--cases 300");
  line = std::regex_replace(line, std::regex(" --limit [0-9]+"), "");
  if (line.find(" certify --subject") != std::string::npos) line += " --limit 40";
  return line;
}

// A repository ~/box3d of a stand-in, whose last commit but one is wrong, and ~/box3d-build, which installs
// it.
void make_library(const Workspace& w) {
  fs::copy(TS_SOURCE_DIR "/tests/oracles/stubs/box3d", w.dir / "box3d", fs::copy_options::recursive);
  w.write(
      "box3d/CMakeLists.txt",
      "cmake_minimum_required(VERSION 3.16)\nproject(box3d)\ninstall(DIRECTORY include lib DESTINATION .)\n");
  fs::create_directory(w.dir / "box3d-build");
  w.write("box3d-build/Makefile", "install:\n\ttrue\n");
  const Run r = w.run(
      "cd box3d && git init -q -b main && git config user.email test@example.org && git config user.name "
      "Test && "
      "git add -A && git commit -q -m first && git tag v0.1 && "
      "sed -i 's/apart - c->radius - s->radius;/apart - c->radius - s->radius - 0.1f;/' "
      "include/box3d/collision.h && "
      "git commit -q -a -m second && git commit -q --allow-empty -m third");
  INFO(r.err);
  REQUIRE(r.code == 0);
}

// Runs a guide's blocks in order in one directory: `sh` is run, `text` lists lines of the output of the block
// above, and a block below a line such as "`file.c`:" is that file. Returns the number of command lines.
std::size_t run_guide(const fs::path& guide) {
  static const std::regex file_name("`([^`/]+)`:");
  const Workspace w("guide-" + guide.stem().string());
  if (guide.stem() == "engines") make_library(w);
  setenv("TOUCHSTONE_ENGINES", (w.dir / "registered").c_str(), 1);
  setenv("XDG_CACHE_HOME", (w.dir / "cache").c_str(), 1);
  std::size_t run = 0;
  std::string out;
  for (const Block& block : blocks_of(guide)) {
    std::smatch m;
    if (std::regex_match(block.before, m, file_name)) w.write(m[1], block.text);
    if (block.language == "text")
      for (const std::string& line : lines_of(block.text)) {
        INFO(out << "\nshould contain: " << line);
        CHECK(out.find(line) != std::string::npos);
      }
    if (block.language != "sh") continue;
    out.clear();
    for (const std::string& line : lines_of(block.text)) {
      if (line.starts_with("./touchstone")) continue;
      const Run r = w.run(in_workspace(w, line));
      INFO(line << "\n" << r.out << r.err);
      CHECK(r.code == 0);
      out += r.out;
      ++run;
    }
  }
  return run;
}

}  // namespace

TEST_CASE("every command line of the README and the pages runs in the checkout", "[readme]") {
  std::size_t run = 0;
  const Workspace w("readme-npm");
  const NpmRegistry npm(w);
  fs::remove_all(TS_BINARY_DIR "/readme-shards");
  fs::remove_all(TS_BINARY_DIR "/readme-new");  // as in a new checkout: the commands make their directories
  for (const std::string& line : all_commands_in_checkout()) {
    if (line == "./touchstone test") continue;
    if (is_about_npm(line) && !has_command("node")) continue;
    if (is_about_pages_alone(line) && !fs::exists(TS_BINARY_DIR "/share/touchstone/web/index.html")) continue;
    if (line.find(" fuzz ") != std::string::npos) fs::remove_all(TS_BINARY_DIR "/readme-out");
    const std::string adapted = is_about_npm(line) ? with_registry(for_test(line), w, npm) : for_test(line);
    const std::string command = "cd " TS_SOURCE_DIR " && " + adapted + " >/dev/null </dev/null";
    const int status = std::system(command.c_str());
    INFO(line);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    ++run;
  }
  fs::remove_all(TS_BINARY_DIR "/readme-out");
  fs::remove_all(TS_BINARY_DIR "/readme-shards");
  fs::remove_all(TS_BINARY_DIR "/readme-new");
  CHECK(run >= 30);
}

TEST_CASE("scripts in the pages are sound", "[readme]") {
  const Workspace w("readme-scripts");
  std::size_t checked = 0;
  for (const fs::path& page : pages())
    for (const Block& block : blocks_of(page)) {
      if (block.language != "bash") continue;
      const Run r = w.run("sh -n " + w.write("script.sh", block.text).string());
      INFO(page << "\n" << block.text << r.err);
      CHECK(r.code == 0);
      ++checked;
    }
  CHECK(checked >= 2);
}

TEST_CASE("jobs in the pages are YAML", "[readme][optional]") {
  if (!touchstone::test::has_python_with("yaml"))
    return touchstone::test::skip("python3-yaml is not installed");
  const Workspace w("readme-yaml");
  std::size_t checked = 0;
  for (const fs::path& page : pages())
    for (const Block& block : blocks_of(page)) {
      if (block.language != "yaml") continue;
      const Run r =
          w.run("python3 -c 'import sys, yaml; assert isinstance(yaml.safe_load(open(sys.argv[1])), dict)' " +
                w.write("job.yaml", block.text).string());
      INFO(page << "\n" << block.text << r.err);
      CHECK(r.code == 0);
      ++checked;
    }
  CHECK(checked >= 3);
}

TEST_CASE("every command line of the guides runs, and prints what they say", "[readme][optional]") {
  for (const char* needed : {"python3", "git", "make"})
    if (!has_command(needed)) return touchstone::test::skip(std::string(needed) + " is not installed");
  if (!touchstone::test::has_python_with("numpy, pip"))
    return touchstone::test::skip("python3-numpy or python3-pip is not installed");
  std::size_t run = 0;
  for (const fs::path& page : pages())
    if (page.stem() != "core-library")
      run += run_guide(page);  // tests/core/library_test.cpp builds its example
  CHECK(run >= 12);
}
