// Rounded boxes: closed forms, boxes with the radii taken off, hulls of many points inside; certificates,
// motions, contact regions.
#include <numbers>

#include "oracles/checker/checker.h"
#include "oracles/referee/referee.h"
#include "oracles/referee/region/contact_region.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;

namespace {

RoundedBox random_rounded(Rng& r) {
  const auto s = [&] { return std::pow(10.0, r.uniform(-1, 0)); };
  const double x = s(), y = s(), z = s();
  return {{x, y, z}, r.chance(0.2) ? 1e-6 * s() : s()};
}

bool accepted(const PairTruth& t, const Placed& a, const Placed& b) {
  return checker::check(checkable_certificate(t, a, b), a, b);
}

}  // namespace

TEST_CASE("rounded boxes along the axes: the distance of two boxes, minus the radii", "[referee][rounded]") {
  Rng r(31);
  int overlaps = 0;
  constexpr int cases = 1000;
  for (int i = 0; i < cases; ++i) {
    const RoundedBox x = random_rounded(r), y = random_rounded(r);
    const Shape sx = x, sy = y;
    const Vec3 at = r.unit_vector() * r.uniform(0.5, 4);
    const Placed a{&sx, Pose{}}, b{&sy, Pose{at, {}}};
    const PairTruth t = judge_pair(a, b);
    long double apart_sq = 0;
    for (int k = 0; k < 3; ++k) {
      const long double d = std::abs((long double)at[k]) - x.half_extents[k] - y.half_extents[k];
      if (d > 0) apart_sq += d * d;
    }
    REQUIRE(t.verdict != Verdict::undecided);
    REQUIRE(accepted(t, a, b));
    overlaps += t.verdict == Verdict::overlap;
    if (apart_sq == 0) continue;  // the cores overlap
    const long double g = std::sqrt(apart_sq) - x.radius - y.radius;
    REQUIRE((t.verdict == Verdict::overlap) == (g <= 0));
    REQUIRE(static_cast<long double>(t.gap.lo) <= g + 1e-17L);
    REQUIRE(static_cast<long double>(t.gap.hi) >= g - 1e-17L);
    REQUIRE(t.gap.hi - t.gap.lo <= 1e-14);
  }
  REQUIRE(overlaps > cases / 5);
  REQUIRE(overlaps < cases * 7 / 10);
}

TEST_CASE("rounded boxes in any position: the gap of their boxes, minus the radii", "[referee][rounded]") {
  Rng r(32);
  int overlaps = 0, deep = 0;
  constexpr int cases = 400;
  for (int i = 0; i < cases; ++i) {
    const RoundedBox x = random_rounded(r), y = random_rounded(r);
    const Shape sx = x, sy = y, box_x = Box{x.half_extents}, box_y = Box{y.half_extents};
    const Pose p{Vec3::Zero(), r.rotation()}, q{r.unit_vector() * r.uniform(0, 3), r.rotation()};
    const Placed a{&sx, p}, b{&sy, q};
    const PairTruth t = judge_pair(a, b), cores = judge_pair({&box_x, p}, {&box_y, q});
    const double radii = x.radius + y.radius;
    REQUIRE(t.gap.lo <= cores.gap.hi - radii + 1e-15);
    REQUIRE(t.gap.hi >= cores.gap.lo - radii - 1e-15);
    REQUIRE(t.gap.hi - t.gap.lo <= 1e-13);
    REQUIRE(accepted(t, a, b));
    if (t.verdict == Verdict::overlap) {
      REQUIRE(checker::check(depth_certificate(t, a, b), a, b));
      ++overlaps;
    }
    deep += cores.verdict == Verdict::overlap;
  }
  REQUIRE(overlaps > cases / 5);
  REQUIRE(overlaps < cases * 9 / 10);
  REQUIRE(deep > cases / 10);
}

TEST_CASE("a rounded box is nearer than any hull of its points, by no more than they leave out",
          "[referee][rounded]") {
  Rng r(33);
  int cases = 0;
  for (int i = 0; i < 12; ++i) {
    const RoundedBox x = random_rounded(r);
    // Corners ⊕ a regular grid of directions, each within `angle` of every direction of its octant.
    constexpr int steps = 8;
    const double angle =
        std::numbers::pi / 4 / steps;  // half a step in each of two angles, and a little more
    Hull inside;
    for (int corner = 0; corner < 8; ++corner)
      for (int u = 0; u <= steps; ++u)
        for (int v = 0; v <= steps; ++v) {
          const double p = std::numbers::pi / 2 * u / steps, q = std::numbers::pi / 2 * v / steps;
          const Vec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
          const Vec3 n(std::cos(p) * std::cos(q), std::sin(p) * std::cos(q), std::sin(q));
          inside.vertices.push_back(sign.cwiseProduct(x.half_extents + x.radius * n));
        }
    const Shape sx = x, hull = inside, other = random_convex(r, tested_kinds[r.below(7)]);
    const Pose p{Vec3::Zero(), r.rotation()}, q{r.unit_vector() * r.uniform(1.5, 4), r.rotation()};
    const PairTruth t = judge_pair({&sx, p}, {&other, q}), h = judge_pair({&hull, p}, {&other, q});
    const double left_out = x.radius * (1 - std::cos(2 * angle)), rounding = 1e-13;
    REQUIRE(t.gap.lo <= h.gap.hi + rounding);
    REQUIRE(t.gap.hi >= h.gap.lo - left_out - rounding);
    ++cases;
  }
  REQUIRE(cases == 12);
}

TEST_CASE("exact touching of rounded boxes is overlap, one ulp apart is disjoint",
          "[referee][rounded][exact]") {
  const Shape cube = RoundedBox{{1, 1, 1}, 2.5}, small = RoundedBox{{1, 1, 1}, 2}, ball = Sphere{5},
              thin = RoundedBox{{1, 1, 1}, 0x1p-40};
  const auto verdict = [](const Shape& a, const Shape& b, const Vec3& at) {
    const Placed x{&a, Pose{}}, y{&b, Pose{at, {}}};
    const PairTruth t = judge_pair(x, y);
    REQUIRE(accepted(t, x, y));
    return t.verdict;
  };
  const auto next = [](double x) { return std::nextafter(x, 1e9); };
  CHECK(verdict(cube, cube, {7, 0.5, 0}) == Verdict::overlap);  // faces: 2 + 2.5 + 2.5
  CHECK(verdict(cube, cube, {next(7), 0.5, 0}) == Verdict::disjoint);
  CHECK(verdict(cube, cube, {5, 6, 1}) == Verdict::overlap);  // edges: |(3, 4)| = 5
  CHECK(verdict(cube, cube, {next(5), 6, 1}) == Verdict::disjoint);
  CHECK(verdict(small, ball, {3, 4, 7}) == Verdict::overlap);  // a corner: |(2, 3, 6)| = 7
  CHECK(verdict(small, ball, {3, 4, next(7)}) == Verdict::disjoint);
  CHECK(verdict(thin, thin, {2 + 0x1p-39, 0, 0}) == Verdict::overlap);
  CHECK(verdict(thin, thin, {next(2 + 0x1p-39), 0, 0}) == Verdict::disjoint);
}

TEST_CASE("a rounded box without radius is a box, without extents a ball", "[referee][rounded]") {
  Rng r(34);
  for (int i = 0; i < 100; ++i) {
    const RoundedBox x = random_rounded(r);
    const Shape sharp = RoundedBox{x.half_extents, 0}, box = Box{x.half_extents},
                round = RoundedBox{Vec3::Zero(), x.radius}, ball = Sphere{x.radius};
    const Shape other = random_convex(r, tested_kinds[r.below(7)]);
    const Pose p{Vec3::Zero(), r.rotation()}, q{r.unit_vector() * r.uniform(0, 2), r.rotation()};
    const auto same = [&](const Shape& s, const Shape& t) {
      const Bracket u = judge_pair({&s, p}, {&other, q}).gap, v = judge_pair({&t, p}, {&other, q}).gap;
      CHECK(u.lo <= v.hi);
      CHECK(v.lo <= u.hi);
    };
    same(sharp, box);
    same(round, ball);
  }
}

TEST_CASE("a rounded box in motion: times of closed form, certificates that the checker accepts",
          "[referee][rounded][motion]") {
  const Shape cube = RoundedBox{{1, 1, 1}, 0.5};
  const Placed a{&cube, Pose{}};
  const auto hits = [&](const Vec3& from, const Vec3& linear, const Vec3& angular, double t) {
    const Placed b{&cube, Pose{from, {}}};
    const Motion rest, m{linear, angular};
    const TimeTruth truth = judge_motion(a, rest, b, m);
    REQUIRE(truth.verdict == TimeTruth::Verdict::hit);
    CHECK(truth.t_lo <= t + 1e-12);
    CHECK(truth.t_hi >= t - 1e-12);
    CHECK(truth.t_hi - truth.t_lo <= 1e-9);
    CHECK(checker::check(impact_certificate(a, rest, b, m, truth), a, rest, b, m));
  };
  hits({5, 0.25, 0}, {-4, 0, 0}, {0, 0, 0}, 0.5);  // faces 2 apart
  // Edges: cores |(x - 2, 0.8)| apart, 1 when x = 2.6.
  hits({6.6, 2.8, 0.25}, {-8, 0, 0}, {0, 0, 0}, 0.5);
  // A ball about its own centre: the rotation does not show.
  const Shape ball = RoundedBox{{0, 0, 0}, 1};
  const Placed b{&ball, Pose{{5.5, 0, 0}, {}}};
  const TimeTruth truth = judge_motion(a, {}, b, {{-6, 0, 0}, {3, 1, 2}});
  REQUIRE(truth.verdict == TimeTruth::Verdict::hit);
  CHECK(truth.t_lo <= 0.5 + 1e-12);
  CHECK(truth.t_hi >= 0.5 - 1e-12);
}

TEST_CASE("a rotating rounded box touches when its core comes within the radii",
          "[referee][rounded][motion]") {
  Rng r(35);
  int hit = 0, decided = 0;
  constexpr int cases = 40;
  for (int i = 0; i < cases; ++i) {
    const RoundedBox x = random_rounded(r), y = random_rounded(r);
    const Shape sx = x, sy = y;
    const Vec3 from = r.unit_vector() * 4;
    const Placed a{&sx, Pose{Vec3::Zero(), r.rotation()}}, b{&sy, Pose{from, r.rotation()}};
    const Motion rest, m{-from + r.vector(0, 1.5), r.vector(0.1, 2)};
    const TimeTruth t = judge_motion(a, rest, b, m);
    decided += t.verdict != TimeTruth::Verdict::undecided;
    if (t.verdict != TimeTruth::Verdict::hit) continue;
    ++hit;
    CHECK(gap_at(a, rest, b, m, t.t_lo).hi >= -1e-9);
    CHECK(gap_at(a, rest, b, m, t.t_hi).lo <= 1e-9);
    const ImpactCertificate c = impact_certificate(a, rest, b, m, t);
    CHECK(checker::check(c, a, rest, b, m));
  }
  CHECK(hit > cases / 4);
  CHECK(decided == cases);
}

TEST_CASE("a certificate of a rounded box is refused for a larger radius", "[referee][rounded][checker]") {
  const Shape cube = RoundedBox{{1, 1, 1}, 0.5}, larger = RoundedBox{{1, 1, 1}, 0.5625};
  const Placed a{&cube, Pose{}}, b{&cube, Pose{{3.03125, 0, 0}, {}}}, wide{&larger, b.pose};
  const PairTruth apart = judge_pair(a, b);
  const Certificate c = checkable_certificate(apart, a, b);
  REQUIRE(apart.verdict == Verdict::disjoint);
  CHECK(checker::check(c, a, b));
  CHECK_FALSE(checker::check(c, a, wide));
  const Placed in{&larger, Pose{{2.5, 0, 0}, {}}}, smaller{&cube, in.pose};
  const PairTruth deep = judge_pair(a, in);
  const Certificate depth = depth_certificate(deep, a, in);
  CHECK(checker::check(depth, a, in));
  CHECK_FALSE(checker::check(depth, a, smaller));
}

TEST_CASE("the contact region of a rounded box is that of its faces and edges",
          "[referee][rounded][region]") {
  const Shape cube = RoundedBox{{1, 1, 1}, 0.5}, slab = Box{{4, 4, 1}}, ground = HalfSpace{{0, 0, 1}, 1};
  constexpr double slack = 1e-7;
  const Vec3 down(0, 0, -1);
  using Kind = ContactRegion::Kind;
  const ContactRegion on_slab =
      contact_region({&cube, Pose{{0.5, 0, 2.5}, {}}}, {&slab, Pose{}}, down, slack);
  REQUIRE(on_slab.kind == Kind::polygon);
  CHECK(on_slab.area == Approx(4).epsilon(1e-12));
  for (const Vec3& v : on_slab.vertices) CHECK(v.z() == Approx(1).margin(1e-12));
  const ContactRegion stack = contact_region({&cube, Pose{{0.5, 0.25, 3}, {}}}, {&cube, Pose{}}, down, slack);
  CHECK(stack.area == Approx(1.5 * 1.75).epsilon(1e-12));
  // On its edge.
  const ContactRegion edge =
      contact_region({&cube, Pose{{0, 0, 3}, {1, 0, 0, 1 + std::sqrt(2.0)}}}, {&ground, Pose{}}, down, slack);
  REQUIRE(edge.kind == Kind::segment);
  CHECK(edge.length == Approx(2));
}
