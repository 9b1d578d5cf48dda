// `bisect commit --source`: the commit of a library's history that came with a fault.
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void replace(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = read_all(file);
  const auto at = text.find(from);
  INFO(file << " has no " << from);
  REQUIRE(at != std::string::npos);
  std::ofstream(file) << text.replace(at, from.size(), to);
}

struct History : Workspace {
  using Workspace::Workspace;

  void must(const std::string& line) const {
    const Run r = run(line);
    INFO(line << "\n" << r.out << r.err);
    REQUIRE(r.code == 0);
  }
  void start(const std::string& repository) const {
    must("git -C " + repository + " init -q -b main && git -C " + repository +
         " config user.email test@example.org && git -C " + repository + " config user.name Test");
  }
  // Returns the commit's hash.
  std::string commit(const std::string& repository, const std::string& subject) const {
    must("git -C " + repository + " add -A && git -C " + repository + " commit -q --allow-empty -m '" +
         subject + "'");
    std::string hash = run("git -C " + repository + " rev-parse HEAD").out;
    hash.pop_back();
    return hash;
  }
};

// Spheres of radius 1 and 0.5, 0.25 deep.
const std::string spheres = R"({"touchstone_case":1,"scene":{"touchstone_scene":1,
"shapes":[{"type":"sphere","radius":1},{"type":"sphere","radius":0.5}],
"bodies":[{"shape":0,"pose":{"translation":[0,0,0],"rotation":[0,0,0,1]}},
{"shape":1,"pose":{"translation":[0,0,1.25],"rotation":[0,0,0,1]}}]},
"queries":[{"question":"contact","a":0,"b":1}]})";

const std::string library_project = R"(cmake_minimum_required(VERSION 3.16)
project(box3d LANGUAGES CXX)
install(DIRECTORY include lib DESTINATION .)
)";

}  // namespace

TEST_CASE("bisect commit builds each commit once, skips what does not build, and names the wrong one",
          "[own][bisect]") {
  const History w("bisect-stub");
  w.write("case.json", spheres);
  fs::copy(TS_SOURCE_DIR "/tests/oracles/stubs/box3d", w.dir / "library", fs::copy_options::recursive);
  w.start("library");
  w.write("library/CMakeLists.txt", library_project);
  const std::string first = w.commit("library", "first");
  w.write("library/README", "words");
  w.commit("library", "words");
  const fs::path header = w.dir / "library/include/box3d/collision.h";
  w.write("library/CMakeLists.txt", "this is not CMake");
  const std::string unbuildable = w.commit("library", "does not configure");
  w.write("library/CMakeLists.txt", library_project);
  w.commit("library", "configures again");
  replace(header, "apart - c->radius - s->radius;", "apart - c->radius - s->radius - 0.1f;");
  const std::string wrong = w.commit("library", "measures from elsewhere");
  w.write("library/README", "more words");
  w.commit("library", "more words");
  w.commit("library", "same files as before");
  w.write("library/dirty", "not committed");

  const std::string bisect = "bisect commit case.json --engine box3d --source library --cache cache ";
  const auto answer = [&](const std::string& commit) { return w.touchstone(bisect + "--commit " + commit); };
  CHECK(answer(first).code == 0);
  CHECK(answer(unbuildable).code == 125);
  const Run bad = answer(wrong);
  CHECK(bad.code == 1);
  CHECK(has(bad.err, "box3d.contact."));
  CHECK(answer("HEAD").code == 1);
  const auto abort = [&](const std::string& arguments, const std::string& why) {
    const Run r = w.touchstone("bisect commit " + arguments);
    INFO(arguments << "\n" << r.err);
    CHECK(r.code == 128);  // ends `git bisect run`, which would take 1 to 127 for a verdict
    CHECK(has(r.err, why));
  };
  abort("case.json --engine box3d --source library --cache cache --commit none", "is not in library");
  abort("case.json --engine box4d --source library --cache cache", "did you mean box3d");
  abort("case.json --engine box3d --source . --cache cache", "is not a git repository");
  abort("none.json --engine box3d --source library --cache cache", "no such file");

  const Run found = w.touchstone(bisect + "--good " + first);
  INFO(found.out << found.err);
  CHECK(found.code == 0);
  CHECK(has(found.out, "first bad commit: " + wrong.substr(0, 7)));
  CHECK(has(found.out, "measures from elsewhere"));
  const Run again = w.touchstone(bisect + "--good " + first);
  CHECK(has(again.out, "0 built, "));
  CHECK(again.out.substr(0, again.out.find('\n')) == found.out.substr(0, found.out.find('\n')));

  // As git runs it.
  w.must("git -C library stash -q -u && git -C library bisect start HEAD " + first);
  const Run by_git =
      w.run("cd library && git bisect run " TS_BINARY_DIR
            "/bin/touchstone bisect commit ../case.json --engine box3d --source . --cache ../cache");
  INFO(by_git.out << by_git.err);
  CHECK(has(by_git.out, wrong + " is the first bad commit"));
  w.must("git -C library bisect reset");

  const Run reversed = w.touchstone(bisect + "--good " + wrong);
  CHECK(reversed.code == 3);
  CHECK(has(reversed.err, "is wrong already"));
  const Run nothing = w.touchstone(bisect + "--good " + first + " --bad " + first + "~0");
  CHECK(nothing.code == 3);
  CHECK(has(nothing.err, "there is nothing to look for"));
  const Run between = w.touchstone(bisect + "--good " + unbuildable);
  CHECK(between.code == 3);
  CHECK(has(between.err, "cannot be tested"));
}

namespace {

// Debian's source of libccd 2.1, by a private configuration of apt, because deb-src lines are usually absent.
bool fetch_libccd(const History& w) {
  if (!has_command("apt-get") || !has_command("dpkg-source")) return false;
  fs::create_directories(w.dir / "apt/lists/partial");
  fs::create_directories(w.dir / "apt/cache/archives/partial");
  w.write("apt/sources.list",
          "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian "
          "bookworm main\n");
  const std::string here = (w.dir / "apt").string();
  const std::string apt =
      "apt-get -q -o APT::Sandbox::User=root -o Acquire::Retries=0 -o Acquire::http::Timeout=10 "
      "-o Dir::Etc::SourceList=" +
      here +
      "/sources.list -o Dir::Etc::SourceParts=/dev/null "
      "-o Dir::State::Lists=" +
      here + "/lists -o Dir::Cache=" + here + "/cache ";
  return w.run(apt + "update && " + apt + "source libccd=2.1-2 && mv libccd-2.1 libccd").code == 0 &&
         fs::exists(w.dir / "libccd/src/mpr.c");
}

}  // namespace

TEST_CASE("bisect commit names the wrong commit of libccd's source", "[own][bisect][optional]") {
  const History w("bisect-libccd");
  if (!has_command("git") || !fetch_libccd(w)) return skip("Debian's source of libccd cannot be had");
  w.start("libccd");
  const std::string good = w.commit("libccd", "libccd 2.1");
  replace(w.dir / "libccd/README.md", "libccd", "libccd, ");
  w.commit("libccd", "punctuation");
  // Where the line through both centres gives the depth, as for two spheres.
  replace(w.dir / "libccd/src/mpr.c", "*depth = CCD_SQRT(ccdVec3Len2(dir));",
          "*depth = CCD_SQRT(ccdVec3Len2(dir)) / 2;");
  const std::string wrong = w.commit("libccd", "halves a depth");
  replace(w.dir / "libccd/README.md", "libccd, ", "libccd");
  w.commit("libccd", "punctuation again");
  w.write("case.json", spheres);
  const Run found = w.touchstone(
      "bisect commit case.json --engine libccd-mpr --source libccd --cache cache --good " + good);
  INFO(found.out << found.err);
  CHECK(found.code == 0);
  CHECK(has(found.out, "first bad commit: " + wrong.substr(0, 7)));
  CHECK(has(found.out, "halves a depth"));
}
