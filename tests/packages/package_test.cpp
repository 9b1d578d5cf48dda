// The Debian package: made by cpack, unpacked elsewhere, and run where the source and the build are hidden.
#include <fstream>
#include <regex>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using touchstone::test::has_command;
using touchstone::test::read_all;
using touchstone::test::Run;
using touchstone::test::skip;
using touchstone::test::Workspace;

namespace {

// Runs a line with the checkout and the build directory replaced by empty directories.
Run run_alone(const Workspace& w, const std::string& line) {
  w.write("alone.sh",
          "mount -t tmpfs none " TS_BINARY_DIR " && mount -t tmpfs none " TS_SOURCE_DIR "\n" + line + "\n");
  return w.run("unshare -m sh alone.sh");
}

}  // namespace

TEST_CASE("the Debian package works where it is unpacked, without the checkout", "[packages][optional]") {
  if (!has_command("cpack") || !has_command("dpkg-shlibdeps"))
    return skip("cpack or dpkg-dev is not installed");
  const Workspace w("package");
  if (run_alone(w, "test ! -e " TS_SOURCE_DIR "/CMakeLists.txt").code != 0)
    return skip("directories cannot be hidden here (unshare -m)");
  const Run made = w.run("cpack --config " TS_BINARY_DIR "/CPackConfig.cmake -G DEB -B .");
  INFO(made.out << made.err);
  REQUIRE(made.code == 0);
  REQUIRE(w.run("dpkg -x touchstone_*.deb moved").code == 0);
  const std::string control = w.run("dpkg -f touchstone_*.deb Depends").out;
  CHECK(control.find("libc6") != std::string::npos);

  const Run answer = run_alone(w, "moved/usr/bin/touchstone answer 'box 1 1 1' 'box 1 1 1 at 2.375 2.5 0'");
  INFO(answer.out << answer.err);
  CHECK(answer.code == 0);
  CHECK(answer.out.find("disjoint") != std::string::npos);
  const Run doctor = run_alone(w, "moved/usr/bin/touchstone doctor");
  INFO(doctor.out << doctor.err);
  CHECK(doctor.out.find("installed without its sources") != std::string::npos);
  const bool has_ode =
      run_alone(w, "moved/usr/bin/touchstone engines").out.find("\node ") != std::string::npos;
  CHECK((doctor.out.find("  ok      ode") != std::string::npos) == has_ode);
  const Run fuzz = run_alone(w, "moved/usr/bin/touchstone fuzz --cases 50 --engines core --out out");
  INFO(fuzz.out << fuzz.err);
  CHECK(fuzz.code == 0);
  CHECK(fuzz.out.find("0 wrong in") != std::string::npos);
  const Run replay =
      run_alone(w, "moved/usr/bin/touchstone replay drake-1668-cubes-corner-overlap --engines core");
  INFO(replay.out << replay.err);
  CHECK(replay.code == 0);
  const Run corpus = run_alone(w, "moved/usr/bin/touchstone corpus run --engine core");
  INFO(corpus.out << corpus.err);
  CHECK(corpus.code == 0);
}

TEST_CASE("the image's recipe names files that exist and installs the packages that the build needs",
          "[packages][optional]") {
  const std::string recipe = read_all(TS_SOURCE_DIR "/Containerfile");
  const std::regex lists("sed 's/ \\.\\*//' (/source\\S+) (/source\\S+)");
  std::smatch m;
  REQUIRE(std::regex_search(recipe, m, lists));
  const Workspace w("recipe");
  const std::string line = std::regex_replace(m[0].str(), std::regex("/source"), TS_SOURCE_DIR);
  const Run packages = w.run(line);
  CHECK(packages.code == 0);
  for (const char* name : {"g++\n", "cmake\n", "ninja-build\n", "libfcl-dev\n", "libode-dev\n"})
    CHECK(packages.out.find(name) != std::string::npos);
}
