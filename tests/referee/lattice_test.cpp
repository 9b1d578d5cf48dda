// Small polytopes on a lattice, judged a second time by the separating-axis theorem over every candidate
// direction in 64-bit integers: slow, obvious, exact. Exact touching is common on a lattice.
#include "oracles/checker/checker.h"
#include "oracles/referee/counters.h"
#include "tests/referee/separating_axis.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;

TEST_CASE("lattice polytopes: verdict, depth and certificate agree with the exhaustive separating-axis test",
          "[referee][exact]") {
  Rng r(20240601);
  int overlaps = 0, touching = 0, certified = 0;
  constexpr int cases = 20000;
  counters() = {};
  for (int i = 0; i < cases; ++i) {
    const Placed3 x = random_polytope(r), y = random_polytope(r);
    const Slow slow = judge_slowly(x.world, y.world, x.scale, y.scale);
    const Placed a{&x.shape, x.pose}, b{&y.shape, y.pose};
    const PairTruth t = judge_pair(a, b);
    INFO("case " << i << " depth " << static_cast<double>(slow.depth));
    REQUIRE(t.verdict == (slow.disjoint ? Verdict::disjoint : Verdict::overlap));
    REQUIRE(t.gap.lo <= t.gap.hi);
    REQUIRE(t.gap.hi - t.gap.lo <= 1e-15 * 16);
    if (!slow.disjoint) {
      ++overlaps;
      touching += slow.depth == 0;
      REQUIRE(static_cast<long double>(t.gap.lo) <= -slow.depth * (1 - 1e-18L));
      REQUIRE(static_cast<long double>(t.gap.hi) >= -slow.depth * (1 + 1e-18L));
    } else {
      REQUIRE(t.gap.hi > 0);
    }
    const Certificate c = checkable_certificate(t, a, b);
    REQUIRE(checker::check(c, a, b));
    ++certified;
  }
  WARN(cases << " cases, " << overlaps << " overlap, " << touching << " of them touch exactly, " << certified
             << " certificates checked, " << counters().exact << " settled in exact arithmetic");
  REQUIRE(overlaps > cases * 3 / 10);
  REQUIRE(overlaps < cases * 7 / 10);
  REQUIRE(touching > 200);
}

TEST_CASE("the checker refuses certificates that prove nothing", "[referee][certificate]") {
  Rng r(5);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const Placed3 x = random_polytope(r), y = random_polytope(r);
    const Placed a{&x.shape, x.pose}, b{&y.shape, y.pose};
    const PairTruth t = judge_pair(a, b);
    Certificate c = checkable_certificate(t, a, b);
    // The right evidence for the wrong verdict, and evidence moved away.
    if (c.kind == Certificate::Kind::separating_plane) {
      for (std::size_t k = 0; k < c.rationals.size() && k < 3; ++k)
        c.rationals[k] = c.rationals[k].front() == '-' ? c.rationals[k].substr(1) : "-" + c.rationals[k];
      c.direction = -c.direction;
      c.offset = -c.offset;
      if (c.rationals.size() == 4)
        c.rationals[3] = c.rationals[3].front() == '-' ? c.rationals[3].substr(1) : "-" + c.rationals[3];
    } else {
      c.rationals.clear();
      c.point += Vec3(100, 0, 0);
    }
    REQUIRE_FALSE(checker::check(c, a, b));
    ++refused;
  }
  REQUIRE(refused == 2000);
}
