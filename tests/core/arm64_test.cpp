// The core, the referee, the checker and the judge on ARM64: built with Debian's cross compiler, run by
// qemu-user.
#include <cstdlib>
#include <regex>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

namespace fs = std::filesystem;
using touchstone::test::has_command;
using touchstone::test::Run;
using touchstone::test::Workspace;

namespace {

// Kept from one run to the next, so that the second is short.
const std::string build = TS_BINARY_DIR "/arm64";

const std::vector<std::string> tests{
    "test_core_double_double",  "test_core_wide",      "test_core_narrow",         "test_core_impact",
    "test_referee_closed_form", "test_referee_curved", "test_referee_certificate", "test_fuzz_judge"};

// Empty when everything needed is present. The build takes a quarter of an hour on two cores, too long to be
// started unasked.
std::string missing() {
  if (!std::getenv("TOUCHSTONE_ARM64")) return "TOUCHSTONE_ARM64=1 is not set";
  for (const char* command : {"aarch64-linux-gnu-g++", "qemu-aarch64", "cmake"})
    if (!has_command(command)) return std::string(command) + " is not installed";
  for (const char* library : {"qhull_r", "hwy", "gmp", "fmt", "z", "sqlite3", "assimp"}) {
    const fs::path stem = "/usr/lib/aarch64-linux-gnu/lib" + std::string(library);
    if (!fs::exists(stem.string() + ".so") && !fs::exists(stem.string() + ".a"))
      return stem.string() + " is not installed";
  }
  return "";
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string all;
  for (const std::string& w : words) all += (all.empty() ? "" : between) + w;
  return all;
}

std::string line_of(const std::string& text, const std::string& name) {
  std::smatch m;
  REQUIRE(std::regex_search(text, m, std::regex("(^|\n)" + name + " ([^\n]+)")));
  return m[2];
}

}  // namespace

TEST_CASE("on ARM64 the tests pass, and answers in double have the same bytes", "[arm64][optional]") {
  if (const std::string what = missing(); !what.empty()) return touchstone::test::skip(what);
  const Workspace w("arm64");
  // -O1: compiles in a third of the time. Rounding does not depend on it. At -O1, g++ 12 takes values that
  // were set for ones that may not have been.
  const Run built = w.run("cmake -S " TS_SOURCE_DIR " -B " + build +
                          " --toolchain " TS_SOURCE_DIR
                          "/cmake/aarch64-linux-gnu.cmake -DCMAKE_BUILD_TYPE=Release "
                          "'-DCMAKE_CXX_FLAGS_RELEASE=-O1 -Wno-maybe-uninitialized' "
                          "-DTOUCHSTONE_WEB=OFF && cmake --build " +
                          build + " --parallel 2 --target ts_core_digest " + joined(tests, " "));
  INFO(built.out.substr(built.out.size() - std::min<std::size_t>(built.out.size(), 4000)) << built.err);
  REQUIRE(built.code == 0);

  const Run tested =
      w.run("ctest --test-dir " + build + " --output-on-failure -R '^(" + joined(tests, "|") + ")$'");
  INFO(tested.out);
  CHECK(tested.code == 0);
  CHECK(tested.out.find("out of " + std::to_string(tests.size())) != std::string::npos);

  const Run there = w.run("qemu-aarch64 -L /usr/aarch64-linux-gnu " + build + "/bin/ts_core_digest");
  const Run here = w.run(TS_BINARY_DIR "/bin/ts_core_digest");
  INFO("ARM64:\n" << there.out << "here:\n" << here.out);
  REQUIRE(there.code == 0);
  REQUIRE(here.code == 0);
  CHECK(line_of(there.out, "cases") == line_of(here.out, "cases"));
  for (const char* name : {"float64_alone", "boxes"})
    CHECK(line_of(there.out, name) == line_of(here.out, name));
  // A motion in double rounds rotations from extended precision: equal where that has the same bits.
  if (line_of(there.out, "wide") == line_of(here.out, "wide"))
    for (const char* name : {"impacts", "extended", "exact_boxes"})
      CHECK(line_of(there.out, name) == line_of(here.out, name));
}
