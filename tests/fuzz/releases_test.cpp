// The search for the first bad release, and what a row of releases says about when a fault came and went.
#include "fuzz/bisect/releases.h"

#include <algorithm>

#include "core/base/input_error.h"
#include "core/math/rng.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::fuzz;

TEST_CASE("the first bad release is found among releases that cannot be asked", "[bisect]") {
  Rng rng(20261123);
  for (int round = 0; round < 2000; ++round) {
    const std::size_t count = 1 + rng.below(40), from = rng.below(count);
    std::vector<Verdict> truth(count);
    for (std::size_t i = 0; i < count; ++i)
      truth[i] = i + 1 < count && rng.chance(0.3) ? Verdict::skip : i >= from ? Verdict::bad : Verdict::good;
    std::vector<std::size_t> asked;
    const FirstBad r = first_bad(count, [&](std::size_t i) {
      asked.push_back(i);
      return truth[i];
    });
    const auto bad =
        static_cast<std::size_t>(std::find(truth.begin(), truth.end(), Verdict::bad) - truth.begin());
    CHECK(r.bad == bad);
    std::optional<std::size_t> good;
    for (std::size_t i = 0; i < bad; ++i)
      if (truth[i] == Verdict::good) good = i;
    CHECK(r.good == good);
    std::vector<std::size_t> between;
    for (std::size_t i = good ? *good + 1 : 0; i < bad; ++i) between.push_back(i);
    CHECK(r.skipped == between);
    std::sort(asked.begin(), asked.end());
    CHECK(std::adjacent_find(asked.begin(), asked.end()) == asked.end());
    CHECK(std::find(asked.begin(), asked.end(), count - 1) == asked.end());
  }
}

TEST_CASE("as many releases are asked as bisection needs", "[bisect]") {
  for (std::size_t from = 0; from < 64; ++from) {
    int asked = 0;
    first_bad(64, [&](std::size_t i) {
      ++asked;
      return i >= from ? Verdict::bad : Verdict::good;
    });
    CHECK(asked <= 6);
  }
}

TEST_CASE("a fault comes with one release and goes with another", "[bisect]") {
  const auto life = [](const std::string& marks) {
    std::vector<ReleaseSays> says;
    for (const char c : marks) says.push_back({static_cast<Showing>(std::string("X~.?-").find(c)), ""});
    return lifetime_of(says);
  };
  CHECK(life("-.XX..").first == 2);
  CHECK(life("-.XX..").not_yet == 1);
  CHECK(life("-.XX..").gone == 4);
  CHECK_FALSE(life("-.XX..").comes_and_goes);
  CHECK(life("XX").first == 0);
  CHECK_FALSE(life("XX").not_yet);
  CHECK_FALSE(life("XX").gone);
  CHECK_FALSE(life("-?X").not_yet);
  CHECK(life(".?X").not_yet == 0);
  // Another fault is not the absence of this one's: only a right answer ends it.
  CHECK_FALSE(life("X~-?").gone);
  CHECK(life("X~.").gone == 2);
  CHECK(life("X.X").comes_and_goes);
  CHECK_FALSE(life("X.X").gone);
  CHECK(life("X.X..").gone == 3);
  CHECK_FALSE(life("..").first);
  CHECK_FALSE(life("").first);
}

TEST_CASE("the fault in a key is the same in every release", "[bisect]") {
  const FaultSought s = fault_in("jolt@0.29.0.contact.missed.box-box.algorithm.none.gross", "jolt@0.29.0");
  CHECK(s.question == "contact");
  CHECK(s.fault == "missed");
  CHECK(s.by == FoundBy::referee);
  CHECK(fault_in("jolt.distance.relation_swapped.box-box.none.none.gross", "jolt").by == FoundBy::relations);
  CHECK(fault_in("jolt.distance.crashed_wasm-7.box-box.none.none.gross", "jolt").fault == "crashed");
  CHECK_THROWS_AS(fault_in("jolt.distance", "jolt"), InputError);
  CHECK_THROWS_AS(fault_in("rapier.distance.missed.a.b.c.d", "jolt"), InputError);
}
