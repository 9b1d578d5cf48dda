// Padded shapes: the gap of the cores less the paddings; certificates that both checkers' rules accept;
// points of curved cores.
#include "oracles/checker/checker.h"
#include "oracles/checker/checker_set.h"
#include "oracles/referee/referee.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;

namespace {

constexpr ShapeKind core_kinds[] = {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid,
                                    ShapeKind::hull};

}  // namespace

TEST_CASE("padded shapes in any position: the gap of their cores, minus the paddings", "[referee][padded]") {
  Rng r(51);
  int overlaps = 0, deep = 0;
  constexpr int cases = 400;
  for (int i = 0; i < cases; ++i) {
    const Shape core_a = random_convex(r, core_kinds[r.below(4)]),
                core_b = random_convex(r, tested_kinds[r.below(7)]);
    const double padding = r.chance(0.2) ? 1e-6 : r.uniform(0.05, 0.6);
    const Shape sa = *padded(core_a, padding), sb = r.chance(0.5) ? core_b : *padded(core_b, padding);
    const double paddings = sb == core_b ? padding : 2 * padding;
    const Pose p{Vec3::Zero(), r.rotation()}, q{r.unit_vector() * r.uniform(0, 3), r.rotation()};
    const Placed a{&sa, p}, b{&sb, q};
    INFO(i << " " << type_name(sa) << " " << type_name(sb));
    const PairTruth t = judge_pair(a, b), cores = judge_pair({&core_a, p}, {&core_b, q});
    REQUIRE(t.verdict != Verdict::undecided);
    CHECK(t.gap.lo <= cores.gap.hi - paddings + 1e-14);
    CHECK(t.gap.hi >= cores.gap.lo - paddings - 1e-14);
    CHECK(t.gap.hi - t.gap.lo <= 1e-12);
    CHECK(checker::check(checkable_certificate(t, a, b), a, b));
    if (t.verdict == Verdict::overlap) CHECK(checker::check(depth_certificate(t, a, b), a, b));
    overlaps += t.verdict == Verdict::overlap;
    deep += cores.verdict == Verdict::overlap;
  }
  CHECK(overlaps > cases / 5);
  CHECK(overlaps < cases * 9 / 10);
  CHECK(deep > cases / 20);
}

TEST_CASE("the checker finds a point of a curved core within reach, and none beyond it",
          "[referee][padded][checker]") {
  Rng r(52);
  int near = 0, beyond = 0;
  for (int i = 0; i < 300; ++i) {
    const Shape core = random_convex(r, core_kinds[r.below(3)]);
    const Pose pose{r.unit_vector(), r.rotation()};
    const Placed placed{&core, pose};
    const Vec3 x = pose.translation + r.unit_vector() * r.uniform(1.5, 4);
    const Shape point = Sphere{0};
    const PairTruth t = judge_pair(placed, {&point, Pose{x, {}}});
    if (!(t.gap.lo > 0.01)) continue;
    const checker::Set set = checker::sets_of(placed).front();
    const auto is_within = [&](double reach) {
      return checker::is_within(set, checker::exact_value(x), checker::Q(reach));
    };
    CHECK(is_within(t.gap.hi + 1e-13));
    CHECK_FALSE(is_within(t.gap.lo * (1 - 1e-15)));
    near += is_within(t.gap.hi + 1e-13);
    beyond += !is_within(t.gap.lo * (1 - 1e-15));
  }
  CHECK(near > 200);
  CHECK(beyond == near);
}
