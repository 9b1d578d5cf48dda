// The last output of a dying process: the relevant part, and what distinguishes crashes.
#include "oracles/abi/last_words.h"

#include <string>

#include "oracles/abi/plugin_kit.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

const std::string fcl_assertion =
    "touchstone-host: ./include/fcl/narrowphase/distance-inl.h:177: typename NarrowPhaseSolver::S "
    "fcl::distance(const CollisionGeometry<typename NarrowPhaseSolver::S>*, " +
    std::string(400, 'x') + ") [with S = double]: Assertion `index != static_cast<std::size_t>(-1)' failed.";

bool contains(const std::string& s, const char* part) { return s.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("an assertion is named by its file and line, and comes before its function",
          "[oracles][last-words]") {
  const LastWords w = last_words("SIGABRT", "noise\n" + fcl_assertion + "\n", true);
  CHECK(w.site == "distance-inl.h:177");
  CHECK(w.detail.starts_with(
      "SIGABRT: distance-inl.h:177: Assertion `index != static_cast<std::size_t>(-1)' failed in typename "));
  CHECK(contains(w.detail, "fcl::distance("));
  CHECK(w.detail.size() <= 1000);
  CHECK(site_word(w.site) == "distance-inl-h-177");
}

TEST_CASE("a call stack names the innermost function, without arguments and addresses",
          "[oracles][last-words]") {
  const std::string stack =
      "\ntouchstone-frames: libfcl.so.0.7+0x1f2a0 _ZN3fcl6detail7collideIdEEbRKT_i+0x30 | "
      "libtouchstone_fcl.so+0x99 | libtouchstone_fcl.so+0xff main+0x1\n";
  const LastWords w = last_words("SIGSEGV", "an earlier line.cpp:7\n" + stack, false);
  CHECK(w.site == "libfcl:detail::collide");
  CHECK(w.detail ==
        "SIGSEGV; at libfcl.so.0.7+0x1f2a0 (fcl::detail::collide) < libtouchstone_fcl.so+0x99 < "
        "libtouchstone_fcl.so+0xff (main)");
  CHECK(site_word(w.site) == "libfcl-detail-collide");
  CHECK(last_words("SIGABRT", fcl_assertion + stack, true).site == "distance-inl.h:177");
  CHECK(last_words("SIGABRT", "free(): invalid pointer" + stack, true).site == "libfcl:detail::collide");
  // A function without a name: its offset differs between builds.
  CHECK(last_words("SIGSEGV", "touchstone-frames: libmine.so+0x99 | libmine.so+0xaa\n", false).site ==
        "libmine");
}

TEST_CASE("other forms of last words", "[oracles][last-words]") {
  CHECK(last_words("exit code 3", "", true).detail == "exit code 3");
  CHECK(last_words("exit code 3", "", true).site.empty());
  CHECK(last_words("SIGABRT",
                   "ODE INTERNAL ERROR 1: assertion \"bNormalizationResult\" failed in _dNormalize4() "
                   "[/build/ode/src/odemath.cpp:190]\n",
                   true)
            .site == "odemath.cpp:190");
  CHECK(last_words("exit code 101", "thread 'main' panicked at src/lib.rs:10:5\n", true).site == "lib.rs:10");
  // A time of day is not a source position, and earlier output of a killed process is unrelated.
  CHECK(last_words("SIGABRT", "at 12:30:05 it failed\n", true).site.empty());
  CHECK(last_words("SIGKILL", fcl_assertion, false).detail == "SIGKILL");
  // Control characters and length.
  CHECK(last_words("SIGABRT", "a\tb\x1b[31m", true).detail == "SIGABRT: a b [31m");
  CHECK(last_words("SIGABRT", std::string(100000, 'y'), true).detail.size() <= 1000);
  CHECK(last_words("SIGABRT", "touchstone-frames:\n", true).site.empty());
  CHECK(last_words("SIGABRT", "touchstone-frames: | + |\n", true).detail.size() < 100);
}

TEST_CASE("Valgrind's reports are passed on without addresses", "[oracles][last-words]") {
  const LastWords w = last_words("exit code 99",
                                 "noise\n==12== Invalid read of size 8\n"
                                 "==12==    at 0x48C: fcl::update(int) (tree.hpp:77)\n"
                                 "==12==    by 0x10A: main (a.cpp:3)\n"
                                 "==12==  Address 0x4dd0040 is 16 bytes inside a block of size 40 free'd\n"
                                 "==12==    at 0x484: free (vg_replace_malloc.c:872)\n==12== \n"
                                 "==12== Exit program on first error (--exit-on-first-error=yes)\n",
                                 true);
  CHECK(w.detail ==
        "exit code 99: Invalid read of size 8 in fcl::update(int) (tree.hpp:77); 16 bytes inside a block of "
        "size 40 free'd");
  CHECK(w.site == "tree.hpp:77");
  CHECK(last_words("exit code 3", "==x== Invalid read\nover\n", true).detail == "exit code 3: over");
}

TEST_CASE("a site's word fits into a key and stays distinct", "[oracles][last-words]") {
  const std::string longer(100, 'a');
  CHECK(site_word("Foo.H:3") == "foo-h-3");
  CHECK(site_word(longer + "1") != site_word(longer + "2"));
  CHECK(site_word(longer).size() <= 48);
  CHECK(site_word("::\xc3\xa9::") == "");
}

TEST_CASE("an exception is named by the file and line in its text", "[oracles][last-words]") {
  CHECK(site_of_exception(
            "Error with configuration\n  Original error message: ./include/fcl/gjk_libccd-inl.h:(1270): "
            "expandPolytope(): no visible face") == "gjk_libccd-inl.h:1270");
  CHECK(site_of_exception("at src/lib.rs:10:5") == "lib.rs:10");
  CHECK(site_of_exception("no such luck").empty());
  CHECK(site_of_exception("at 12:30:05").empty());
  CHECK(site_of_exception("gjk.cpp:(").empty());
  CHECK(site_of_exception("gjk.cpp:()").empty());
  // Bytes of any kind: only those of a path belong to the site.
  CHECK(site_of_exception("\x1b[31m../\x1bgjk.cpp:12") == "gjk.cpp:12");
}

TEST_CASE("a message too long for an answer names files without directories", "[oracles][last-words]") {
  const std::string path = "./include/fcl/narrowphase/detail/convexity_based_algorithm/gjk_libccd-inl.h";
  const std::string text = "Error with configuration\n  Original error message: " + path +
                           ":(1270): expandPolytope(): no visible face";
  REQUIRE(text.size() > sizeof(ts_answer::detail));
  ts_answer answer{};
  kit::set_detail(answer, text);
  CHECK(std::string(answer.detail) ==
        "Error with configuration\n  Original error message: gjk_libccd-inl.h:(1270): expandPolytope(): no "
        "visible face");
  CHECK(site_of_exception(answer.detail) == "gjk_libccd-inl.h:1270");
  kit::set_detail(answer, path);
  CHECK(answer.detail == path);
  kit::set_detail(answer, std::string(1000, 'x'));
  CHECK(std::string(answer.detail) == std::string(sizeof answer.detail - 1, 'x'));
}
