// Times of impact against the referee: hits and misses, the gap at the time, the depth before it.
#include "core/ccd/impact.h"
#include "core/tolerance.h"
#include "oracles/referee/referee.h"
#include "tests/core/random_course.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;

TEST_CASE("impact: never missed, late, early or a ghost, by the referee", "[impact][referee]") {
  using Verdict = referee::TimeTruth::Verdict;
  int cases = 0, hits = 0, decided = 0;
  for (std::uint64_t i = 0; i < 240; ++i) {
    Rng r = Rng::stream(4242, i);
    const CoursePair c = random_course(r, static_cast<CourseKind>(i % course_count));
    const ImpactAnswer x = time_of_impact({&c.p.a, c.p.pose_a, c.ma}, {&c.p.b, c.p.pose_b, c.mb});
    const referee::Placed a{&c.p.a, c.p.pose_a}, b{&c.p.b, c.p.pose_b};
    const referee::TimeTruth truth = referee::judge_motion(a, c.ma, b, c.mb);
    const double tau = tolerance::core_tau_factor * 0x1p-53 * scale_of(c);
    INFO("case " << i);
    REQUIRE(x.outcome == Outcome::answered);
    ++cases, hits += x.toi.has_value(), decided += truth.verdict != Verdict::undecided;
    if (!x.toi) {
      CHECK(referee::certified_depth_before(a, c.ma, b, c.mb, 1) <= tau);
      continue;
    }
    if (truth.verdict == Verdict::none) CHECK(truth.least_gap.lo <= tau);
    if (*x.toi == 0) {
      CHECK(referee::gap_at(a, c.ma, b, c.mb, 0).lo <= tau);
      continue;
    }
    CHECK(referee::gap_at(a, c.ma, b, c.mb, *x.toi).lo <= tau);
    CHECK(referee::certified_depth_before(a, c.ma, b, c.mb, *x.toi) <= tau);
    // What is proven clear is clear.
    if (truth.verdict == Verdict::hit) CHECK(x.clear_until <= truth.t_hi);
  }
  INFO(cases << " motions, " << hits << " hits, " << decided << " decided");
  CHECK(hits > 0.3 * cases);
  CHECK(hits < 0.7 * cases);
  CHECK(decided > 0.9 * cases);
}
