// The core and the referee as installed libraries: the example of docs/core-library.md is built against them
// and run.
#include <regex>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/workspace.h"

using touchstone::test::read_all;
using touchstone::test::Run;
using touchstone::test::Workspace;

namespace {

// The first fenced block of a language.
std::string block(const std::string& text, const std::string& language) {
  const std::string fence = "\n```" + language + "\n";
  const auto begin = text.find(fence);
  REQUIRE(begin != std::string::npos);
  const auto from = begin + fence.size();
  return text.substr(from, text.find("```", from) - from);
}

Run built_and_run(const Workspace& w, const std::string& cmake_lists, const std::string& source) {
  w.write("CMakeLists.txt", cmake_lists);
  w.write("example.cpp", source);
  return w.run("rm -rf build && cmake -S . -B build -DCMAKE_PREFIX_PATH=$PWD/prefix " TS_SAME_COMPILER
               " >cmake.log 2>&1 && "
               "cmake --build build >build.log 2>&1 && build/example");
}

Run installed(const Workspace& w, const std::string& component) {
  return w.run("cmake --install " TS_BINARY_DIR " --component " + component + " --prefix prefix");
}

}  // namespace

TEST_CASE("the documented example is built against the installed core and prints what is documented",
          "[library]") {
  const Workspace w("core-library");
  const std::string guide = read_all(TS_SOURCE_DIR "/docs/core-library.md");
  const std::string lists = block(guide, "cmake"), source = block(guide, "cpp");
  REQUIRE(installed(w, "core").code == 0);
  CHECK_FALSE(std::filesystem::exists(w.dir / "prefix/bin"));
  for (const char* library : {"touchstone::core", "touchstone::core_static"}) {
    const Run r =
        built_and_run(w, std::regex_replace(lists, std::regex("touchstone::core"), library), source);
    INFO(library << read_all(w.dir / "cmake.log") << read_all(w.dir / "build.log") << r.err);
    CHECK(r.code == 0);
    CHECK(r.out == block(guide, "text"));
  }
}

TEST_CASE("the installed headers of the core include no other room", "[library]") {
  const Workspace w("core-headers");
  REQUIRE(installed(w, "core").code == 0);
  std::size_t headers = 0;
  for (const auto& e : std::filesystem::recursive_directory_iterator(w.dir / "prefix/include/touchstone")) {
    if (e.path().extension() != ".h") continue;
    ++headers;
    const std::string text = read_all(e.path());
    std::smatch m;
    for (auto from = text.cbegin();
         std::regex_search(from, text.cend(), m, std::regex("#include \"([^\"]+)\""));
         from = m.suffix().first)
      if (!std::filesystem::exists(w.dir / "prefix/include/touchstone" / m[1].str()))
        FAIL_CHECK(e.path() << " includes " << m[1]);
  }
  CHECK(headers > 50);
}

TEST_CASE("the installed referee decides a pair with a certificate that the checker accepts", "[library]") {
  const Workspace w("referee-library");
  REQUIRE(installed(w, "referee").code == 0);
  const Run r = built_and_run(w,
                              "cmake_minimum_required(VERSION 3.16)\nproject(example CXX)\n"
                              "find_package(touchstone REQUIRED COMPONENTS referee)\n"
                              "add_executable(example example.cpp)\n"
                              "target_link_libraries(example touchstone::referee)\n",
                              R"(#include <cstdio>
#include "oracles/checker/checker.h"
#include "oracles/referee/referee.h"
int main() {
  using namespace touchstone;
  const Shape box = Box{{1, 1, 1}}, ball = Sphere{0.5};
  const Placed a{&box, Pose{}}, b{&ball, Pose{{0, 0, 1.75}, {}}};
  const referee::PairTruth t = referee::judge_pair(a, b);
  std::printf("%d %g %d\n", t.verdict == referee::Verdict::disjoint, t.gap.lo,
              checker::check(referee::checkable_certificate(t, a, b), a, b));
}
)");
  INFO(read_all(w.dir / "cmake.log") << read_all(w.dir / "build.log") << r.err);
  CHECK(r.code == 0);
  CHECK(r.out == "1 0.25 1\n");
}
