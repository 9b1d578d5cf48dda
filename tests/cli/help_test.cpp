// What a newcomer asks first: help, unknown commands, doctor, completion, the manual page, the reference. The
// launcher answers them without installing or building.
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

// The launcher with an empty build directory. Programs that install or build leave a mark.
struct Launcher {
  Workspace w{"launcher"};
  fs::path mark = w.dir / "mark", build = w.dir / "build";

  Launcher() {
    fs::create_directories(w.dir / "bin");
    for (const std::string name : {"apt-get", "sudo", "cmake", "ninja"}) {
      const fs::path file =
          w.write("bin/" + name, "#!/bin/sh\necho " + name + " >>" + mark.string() + "\nexit 1\n");
      fs::permissions(file, fs::perms::owner_all);
    }
  }
  Run operator()(const std::string& arguments, const std::string& build_directory = "") const {
    const std::string directory = build_directory.empty() ? build.string() : build_directory;
    return w.run("PATH=" + (w.dir / "bin").string() + ":$PATH TOUCHSTONE_BUILD=" + directory +
                 " " TS_SOURCE_DIR "/touchstone " + arguments);
  }
  bool did_nothing() const { return !fs::exists(mark) && !fs::exists(build); }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// What bash offers after these words; the last one is being typed.
std::string completed(const Workspace& w, const std::string& words) {
  const Run r = w.run("bash -c 'source ./complete.bash; COMP_WORDS=(" + words +
                      "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _touchstone; echo \"${COMPREPLY[@]}\"'");
  INFO(r.err);
  CHECK(r.code == 0);
  return r.out;
}

}  // namespace

TEST_CASE("help and unknown commands neither install nor build", "[cli][help]") {
  const Launcher launcher;
  for (const char* arguments :
       {"--help", "-h", "fuzz --help", "corpus run -h", "build --help", "test --help"}) {
    INFO(arguments);
    const Run r = launcher(arguments);
    CHECK(r.code == 0);
    CHECK(has(r.out, "./touchstone build"));
    CHECK(has(r.out, " fuzz "));
    CHECK(launcher.did_nothing());
  }
  for (const char* arguments : {"fuz", "biuld", "", "--fuzz"}) {
    INFO(arguments);
    CHECK(launcher(arguments).code == 2);
    CHECK(launcher.did_nothing());
  }
  CHECK(has(launcher("fuz").err, "fuz: unknown command"));
  // A command that exists builds.
  CHECK(launcher("families").code == 3);
  CHECK(fs::exists(launcher.mark));
}

TEST_CASE("the launcher asks a program that is built", "[cli][help]") {
  const Launcher launcher;
  const Run unknown = launcher("fuz", TS_BINARY_DIR);
  CHECK(unknown.code == 2);
  CHECK(has(unknown.err, "did you mean fuzz"));
  const Run help = launcher("fuzz --help", TS_BINARY_DIR);
  CHECK(help.code == 0);
  CHECK(has(help.out, "--minutes"));
  CHECK(launcher.did_nothing());
}

TEST_CASE("doctor says what is missing and changes nothing", "[cli][help]") {
  const Launcher launcher;
  const Run shell = launcher("doctor");
  CHECK((shell.code == 0 || shell.code == 3));
  CHECK(launcher.did_nothing());
  const Workspace w("doctor");
  const Run r = w.touchstone("doctor");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  for (const char* part :
       {"To build the program", "Engines of this build", "Programs that some commands run", "Workers"})
    CHECK(has(r.out, part));
  CHECK(has(r.out, "starts and answers"));
  for (const std::string& line : lines_of(r.out)) {
    INFO(line);
    CHECK((line.size() <= 80 || has(line, "engines --install")));
  }
  // Without the programs that it looks for.
  const Run bare = w.run("PATH=/nowhere " TS_BINARY_DIR "/bin/touchstone doctor");
  CHECK(has(bare.out, "missing git"));
  CHECK(has(bare.out, "apt-get install"));
}

TEST_CASE("bash completes commands and options", "[cli][help][optional]") {
  if (!has_command("bash")) return skip("bash is not there");
  const Workspace w("completion");
  const Run script = w.touchstone("completion bash");
  REQUIRE(script.code == 0);
  w.write("complete.bash", script.out);
  CHECK(completed(w, "touchstone fuz") == "fuzz\n");
  CHECK(has(completed(w, "touchstone \"\""), "reproduce"));
  CHECK(completed(w, "touchstone fuzz --minu") == "--minutes\n");
  CHECK(completed(w, "touchstone corpus m") == "make\n");
  CHECK(completed(w, "touchstone corpus run --juni") == "--junit\n");
  CHECK(completed(w, "touchstone corpus run --junit -") == "\n");  // a file
  CHECK(completed(w, "touchstone fuzz --out corpus --minu") == "--minutes\n");
  for (const std::string shell : {"zsh", "fish"}) {
    const Run r = w.touchstone("completion " + shell);
    CHECK(r.code == 0);
    CHECK(has(r.out, "reproduce"));
    CHECK(has(r.out, shell == "zsh" ? "--minutes[" : "-l minutes"));
    w.write("complete." + shell, r.out);
    if (has_command(shell)) CHECK(w.run(shell + " -n complete." + shell).code == 0);
  }
  CHECK(w.touchstone("completion tcsh").code == 2);
}

TEST_CASE("the manual page is sound", "[cli][help][optional]") {
  const Workspace w("man");
  const Run page = w.touchstone("man");
  REQUIRE(page.code == 0);
  CHECK(page.out.starts_with(".TH TOUCHSTONE 1"));
  CHECK(has(page.out, "EXIT STATUS"));
  w.write("touchstone.1", page.out);
  if (!has_command("groff")) return skip("groff is not there; the page was not set");
  const Run set = w.run("groff -K utf8 -man -ww -Tutf8 -P-cbou touchstone.1");
  INFO(set.err.substr(0, 500));
  CHECK(set.code == 0);
  CHECK(set.err.empty());
  CHECK(has(set.out, "reproduce"));
}

TEST_CASE("docs/commands.md is what the program writes", "[cli][help]") {
  const Workspace w("reference");
  const Run r = w.touchstone("man --markdown");
  REQUIRE(r.code == 0);
  const std::string stored = read_all(TS_SOURCE_DIR "/docs/commands.md");
  INFO("./touchstone man --markdown > docs/commands.md");
  CHECK((r.out == stored));
  CHECK_FALSE(has(stored, TS_SOURCE_DIR));
}
