// A pair that never ends, crashes or eats all memory costs itself, and no other pair.
#include "tests/second_referee/limited_run.h"

#include <csignal>
#include <memory>
#include <vector>

#include "tests/support/catch.h"

using namespace touchstone::second_referee;

namespace {

struct Lost {
  std::uint64_t number;
  Stage stage;
  std::string how;
};

void never_end() {
  volatile bool more = true;
  while (more) {
  }
}

void take_all_memory() {
  std::vector<std::unique_ptr<char[]>>
      all;  // address space, untouched: filling it would reach the limit of time
  for (;;) all.push_back(std::make_unique_for_overwrite<char[]>(std::size_t{64} << 20));
}

// Pairs 2, 5, 6 and 9 do not end well; what is left is counted, and pair 7 is a contradiction.
void compare(std::uint64_t number, Progress& p) {
  p.stage = Stage::referee;
  if (number == 2) never_end();
  p.stage = Stage::cgal;
  if (number == 5) never_end();
  if (number == 6) std::raise(SIGKILL);
  if (number == 9) take_all_memory();
  ++p.count.pairs;
  p.count.contradictions += number == 7;
}

}  // namespace

TEST_CASE("a pair that reaches a limit is told and counted, and the run goes on", "[second_referee]") {
  std::vector<Lost> lost;
  const Told told{.lost =
                      [&](std::uint64_t n, Stage s, const std::string& how) {
                        lost.push_back({n, s, how});
                      },
                  .so_far = [](const Progress&) {}};
  const Count c = run_limited(11, {.cpu_seconds = 0.05, .bytes = 1ULL << 30}, compare, told);
  CHECK(c.pairs == 7);
  CHECK(c.contradictions == 1);
  CHECK(c.referee_lost == 1);
  CHECK(c.cgal_lost == 3);
  REQUIRE(lost.size() == 4);
  CHECK(lost[0].number == 2);
  CHECK(lost[0].stage == Stage::referee);
  CHECK(lost[0].how == "no answer in 0.05 CPU seconds");
  CHECK(lost[1].number == 5);
  CHECK(lost[1].stage == Stage::cgal);
  CHECK(lost[2].how == "ended by signal 9");
  CHECK(lost[3].number == 9);
  CHECK(lost[3].how == "ended with exit code 1");
}

TEST_CASE("the last pair may be lost, and no pair is no work", "[second_referee]") {
  std::uint64_t lost = 0;
  const Told told{.lost = [&](std::uint64_t n, Stage, const std::string&) { lost = n; },
                  .so_far = [](const Progress&) {}};
  CHECK(run_limited(7, {.cpu_seconds = 0.05}, compare, told).cgal_lost == 2);
  CHECK(lost == 6);
  CHECK(run_limited(0, {}, compare, told).pairs == 0);
}
