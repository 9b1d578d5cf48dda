// The installed library: a C program by CMake and by pkg-config, the C++ wrapper in test frameworks, the
// Python package from a wheel, and a capture that is replayed.
#include <string>

#include "tests/support/catch.h"
#include "tests/support/python.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using touchstone::test::has_command;
using touchstone::test::read_all;
using touchstone::test::Run;
using touchstone::test::skip;
using touchstone::test::Workspace;

namespace {

const std::string prefix = TS_BINARY_DIR "/test-library-prefix";

void install() {
  static const bool installed = [] {
    const Workspace w("library-install");
    return w.run("cmake --install " TS_BINARY_DIR " --component referee --prefix " + prefix).code == 0;
  }();
  REQUIRE(installed);
}

// A program of the folder, built with CMake against the prefix in the workspace.
Run built(const Workspace& w, const std::string& lists) {
  w.write("CMakeLists.txt", lists);
  return w.run("cmake -S . -B build -DCMAKE_PREFIX_PATH=" + prefix +
               " " TS_SAME_COMPILER " 2>&1 && cmake --build build 2>&1");
}

constexpr const char* sanitized = "the library needs the sanitizers' runtime";

const std::string start = "cmake_minimum_required(VERSION 3.16)\n";
const std::string source = TS_SOURCE_DIR "/tests/library/";

}  // namespace

TEST_CASE("a C program is built against the installed library by CMake, which needs no C++", "[library]") {
  install();
  const Workspace w("library-c");
  const Run b = built(w, start +
                             "project(example C)\nfind_package(touchstone REQUIRED COMPONENTS referee)\n"
                             "add_executable(example " +
                             source + "example.c)\ntarget_link_libraries(example touchstone::library)\n");
  INFO(b.out);
  REQUIRE(b.code == 0);
  const Run r = w.run("build/example");
  CHECK(r.code == 0);
  CHECK(r.out == "gap 0.25, normal z 1\nimpact at 0.25\n\"my engine said 0\": wrong\ncertificate: valid\n");
}

TEST_CASE("pkg-config finds the installed library, whose soname has the major version",
          "[library][optional]") {
  if (!has_command("pkg-config")) return skip("pkg-config is not installed");
  if (touchstone::test::is_sanitized) return skip(sanitized);
  install();
  const Workspace w("library-pkg-config");
  const Run b = w.run("export PKG_CONFIG_PATH=" + prefix +
                      "/lib/pkgconfig && cc -std=c99 -Wall -Wextra -pedantic "
                      "-Werror " +
                      source +
                      "example.c $(pkg-config --cflags --libs touchstone) -o example && "
                      "LD_LIBRARY_PATH=" +
                      prefix + "/lib ./example && pkg-config --modversion touchstone");
  INFO(b.err);
  CHECK(b.code == 0);
  CHECK(b.out.ends_with("certificate: valid\n0.1.0\n"));
  const Run soname = w.run("objdump -p " + prefix + "/lib/libtouchstone.so | grep SONAME");
  CHECK(soname.out.find("libtouchstone.so.0\n") != std::string::npos);
  // No name but those of the header is exported.
  const Run names = w.run("nm -D --defined-only " + prefix +
                          "/lib/libtouchstone.so | awk '$2 != \"A\" {print $3}' | grep -v '^touchstone_'");
  CHECK(names.out.empty());
}

TEST_CASE("the matchers of Catch2 and GoogleTest accept sound answers and say why others are not",
          "[library]") {
  install();
  const Workspace w("library-matchers");
  const Run b = built(w, start +
                             "project(example CXX)\nset(CMAKE_CXX_STANDARD 17)\n"
                             "find_package(touchstone REQUIRED COMPONENTS referee)\nenable_testing()\n"
                             "add_executable(sound " +
                             source +
                             "sound_catch.cpp)\n"
                             "target_link_libraries(sound touchstone::library)\n"
                             "add_test(NAME contacts_are_sound COMMAND sound ~[wrong])\n");
  INFO(b.out);
  REQUIRE(b.code == 0);
  CHECK(w.run("cd build && ctest").code == 0);
  const Run wrong = w.run("build/sound [wrong]");
  CHECK(wrong.code != 0);
  CHECK(wrong.out.find("says 0; the signed distance is 0.25") != std::string::npos);
}

TEST_CASE("the matcher of GoogleTest", "[library][optional]") {
  if (touchstone::test::is_sanitized) return skip(sanitized);
  const Workspace w("library-gtest");
  w.write("probe.cpp", "#include <gtest/gtest.h>\nTEST(a, b) {}\n");
  if (w.run("c++ -std=c++17 probe.cpp -lgtest -lgtest_main -pthread -o probe").code != 0)
    return skip("GoogleTest is not installed");
  install();
  const bool has_gmock =
      w.run("echo '#include <gmock/gmock.h>' | c++ -std=c++17 -E -x c++ - >/dev/null").code == 0;
  const Run b = w.run("c++ -std=c++17 -Wall -Wextra -Werror " + std::string(has_gmock ? "-DHAS_GMOCK " : "") +
                      source + "sound_gtest.cpp -I" + prefix + "/include -L" + prefix +
                      "/lib -ltouchstone -lgtest "
                      "-lgtest_main " +
                      (has_gmock ? "-lgmock " : "") + "-pthread -o sound");
  INFO(b.err);
  REQUIRE(b.code == 0);
  const std::string run = "LD_LIBRARY_PATH=" + prefix + "/lib ./sound --gtest_filter=";
  CHECK(w.run(run + "-*wrong*").code == 0);
  const Run wrong = w.run(run + "*wrong*");
  CHECK(wrong.code != 0);
  CHECK(wrong.out.find("says 0; the signed distance is 0.25") != std::string::npos);
}

TEST_CASE("pip installs the package from the checkout without a network, and its example runs",
          "[library][optional]") {
  if (!touchstone::test::has_python_with("numpy, pip"))
    return skip("python3-numpy or python3-pip is not installed");
  if (touchstone::test::is_sanitized) return skip(sanitized);
  const Workspace w("library-pip");
  const Run pip =
      w.run("TOUCHSTONE_BUILD=" TS_BINARY_DIR
            " PIP_NO_INDEX=1 python3 -m pip install --no-deps --target site " TS_SOURCE_DIR " 2>&1");
  INFO(pip.out);
  REQUIRE(pip.code == 0);
  const Run version = w.run("PYTHONPATH=site python3 -c 'import touchstone; print(touchstone.version())'");
  INFO(version.err);
  CHECK(version.out == "0.1.0\n");
  const Run example =
      w.run("PYTHONPATH=site python3 " TS_SOURCE_DIR "/library/python/examples/check_engine.py");
  INFO(example.err);
  CHECK(example.code == 0);
  CHECK(example.out.find("distances are wrong; the first:\nsays ") != std::string::npos);
  const Run module = w.run("PYTHONPATH=site python3 -m touchstone 'box 1 1 1' 'sphere 0.5 at 0 0 1.75'");
  CHECK(module.code == 0);
  CHECK(module.out.find("\"certified\": true") != std::string::npos);
}

TEST_CASE("a captured query is judged without the engine, and other engines answer beside", "[library]") {
  install();
  const Workspace w("library-capture");
  const Run b = w.run("cc -std=c99 -Wall -Wextra -pedantic -Werror " + source + "capture.c -I" + prefix +
                      "/include -o capture && ./capture capture.jsonl");
  INFO(b.err);
  REQUIRE(b.code == 0);
  const Run r = w.touchstone("replay capture.jsonl");
  INFO(r.out << r.err);
  CHECK(r.code == 1);
  CHECK(r.out.find("capture.jsonl:2: my engine 1.2: box and sphere\n  stated      wrong\n"
                   "              distance_off: says 0; the signed distance is 0.25\n") != std::string::npos);
  CHECK(r.out.find("my engine 1.2                         10         8        2        0        0\n") !=
        std::string::npos);
  std::istringstream lines(r.out);
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 80);
  const Run beside = w.touchstone("replay capture.jsonl --engines core --json");
  CHECK(beside.code == 1);
  CHECK(beside.out.find("\"core\": {") != std::string::npos);
  CHECK(beside.out.find("\"place\": \"capture.jsonl:2\"") != std::string::npos);
  const Run right =
      w.run("sed -n '1p;3p' capture.jsonl >right.jsonl; " TS_BINARY_DIR "/bin/touchstone replay right.jsonl");
  CHECK(right.code == 0);
}
