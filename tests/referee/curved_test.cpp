// All convex pairs: answers known by construction, sampled directions, width of brackets by regime, symmetry.
#include "tests/referee/support.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;

TEST_CASE("answer first: the bracket of a pair placed at a known gap contains that gap", "[referee]") {
  Rng r(31337);
  int reached = 0, undecided = 0;
  for (int i = 0; i < 6000; ++i) {
    const ShapeKind ka = tested_kinds[r.below(7)], kb = tested_kinds[r.below(7)];
    const double size = r.binary_scale(-19, 19), offset = r.chance(0.2) ? 1e6 : 1;
    const Shape sa = random_convex(r, ka, size), sb = random_convex(r, kb, size);
    const Vec3 n = r.unit_vector();
    const Pose pa{size * offset * r.unit_vector(), r.rotation()};
    Pose pb{Vec3::Zero(), r.rotation()};
    const double gap = size * (r.chance(0.5) ? 1 : -1) * std::pow(10.0, r.uniform(-15, -0.5));
    // Support planes of A along n and of B along -n, |gap| apart, support points opposite each other.
    pb.translation = world_support(sa, pa, n) + gap * n - world_support(sb, pb, -n);
    const double length = scale_of(sa, pa.translation, sb, pb.translation), tau = 1e-14 * length;
    const PairTruth t = judge_pair({&sa, pa}, {&sb, pb});
    INFO("case " << i << ": " << type_name(sa) << " " << type_name(sb) << " gap " << gap << " bracket "
                 << t.gap.lo << " " << t.gap.hi << " L " << length);
    REQUIRE(t.gap.lo <= t.gap.hi);
    REQUIRE(t.gap.lo >= gap - tau);  // the direction n proves it
    if (gap > 0) REQUIRE(t.gap.hi <= gap + tau);
    if (gap > tau) REQUIRE(t.verdict == Verdict::disjoint);
    // Pushed so deep that B leaves on the other side: then the direction of that side must show it.
    if (gap < -tau && t.verdict == Verdict::disjoint)
      REQUIRE(t.normal.dot(world_support(sb, pb, -t.normal) - world_support(sa, pa, t.normal)) > -tau);
    undecided += t.verdict == Verdict::undecided;
    ++reached;
  }
  WARN(reached << " cases, " << undecided << " undecided");
  REQUIRE(reached == 6000);
}

TEST_CASE("no sampled direction beats the lower bound of the depth or exceeds the distance", "[referee]") {
  Rng r(99);
  int overlaps = 0, cases = 0;
  for (ShapeKind ka : tested_kinds)
    for (ShapeKind kb : tested_kinds)
      for (int i = 0; i < 8; ++i) {
        const Shape sa = random_convex(r, ka), sb = random_convex(r, kb);
        const Pose pa{Vec3::Zero(), r.rotation()}, pb{r.uniform(0, 1.2) * r.unit_vector(), r.rotation()};
        const PairTruth t = judge_pair({&sa, pa}, {&sb, pb});
        const auto w = [&](const Vec3& n) {
          return n.dot(world_support(sa, pa, n) - world_support(sb, pb, -n)) / n.norm();
        };
        // -w(n) <= gap for every n, so min w >= -gap.hi; and the minimum of the samples comes close to it.
        double least = w(t.normal);
        for (int k = 0; k < 300; ++k) {
          const Vec3 n = k < 150 ? r.unit_vector()
                                 : Vec3(t.normal + std::pow(10.0, r.uniform(-9, -1)) * r.unit_vector());
          least = std::min(least, w(n));
        }
        INFO(type_name(sa) << " " << type_name(sb) << " bracket " << t.gap.lo << " " << t.gap.hi
                           << " least w " << least);
        REQUIRE(least >= -t.gap.hi - 1e-14);
        REQUIRE(w(t.normal) <= -t.gap.lo + 1e-14);
        const Bracket b = width({&sa, pa}, {&sb, pb}, t.normal);
        REQUIRE(std::abs(b.lo - w(t.normal)) <= 1e-14);
        REQUIRE(b.lo <= b.hi);
        REQUIRE(b.hi - b.lo <= 1e-15);
        if (t.verdict == Verdict::disjoint)
          REQUIRE(((t.witness[1] - t.witness[0]) - 0.5 * (t.gap.lo + t.gap.hi) * t.normal).norm() <= 1e-5);
        REQUIRE(distance_to({&sa, pa}, t.witness[0]).lo <= 1e-14);
        REQUIRE(distance_to({&sb, pb}, t.witness[1]).lo <= 1e-14);
        overlaps += t.verdict == Verdict::overlap;
        ++cases;
      }
  WARN(cases << " cases, " << overlaps << " overlap");
  REQUIRE(overlaps > cases * 3 / 10);
  REQUIRE(overlaps < cases * 7 / 10);
}

TEST_CASE("brackets are narrow: polytope and rounded pairs always, curved pairs nearly always",
          "[referee][width]") {
  Rng r(4242);
  const auto pairs = [&](int first, int last, auto&& visit) {
    for (int x = first; x < last; ++x)
      for (int y = 0; y < 7; ++y)
        if (first > 0 || y < last) visit(tested_kinds[x], tested_kinds[y]);
  };
  int wide = 0, cases = 0, undecided = 0;
  const auto measure = [&](ShapeKind ka, ShapeKind kb, bool exact) {
    for (int i = 0; i < 30; ++i) {
      const double size = r.binary_scale(-19, 19);
      const Shape sa = random_convex(r, ka, size), sb = random_convex(r, kb, size);
      const double spread = i % 3 == 0 ? 0.1 : i % 3 == 1 ? 1 : 3;
      const Pose pa{Vec3::Zero(), r.rotation()}, pb{size * spread * r.unit_vector(), r.rotation()};
      const PairTruth t = judge_pair({&sa, pa}, {&sb, pb});
      const double width = (t.gap.hi - t.gap.lo) / scale_of(sa, pa.translation, sb, pb.translation);
      INFO(type_name(sa) << " " << type_name(sb) << " width " << width << " of L");
      if (exact) REQUIRE(width <= 1e-15);
      if (exact) REQUIRE(t.verdict != Verdict::undecided);
      REQUIRE(width <= 1e-2);
      wide += width > 1e-13;
      undecided += t.verdict == Verdict::undecided;
      ++cases;
    }
  };
  pairs(0, exact_kind_count, [&](ShapeKind a, ShapeKind b) { measure(a, b, true); });
  pairs(exact_kind_count, 7, [&](ShapeKind a, ShapeKind b) { measure(a, b, false); });
  WARN(cases << " cases, " << wide << " wider than 1e-13·L, " << undecided << " undecided");
  REQUIRE(wide <= cases / 50);
  REQUIRE(undecided <= cases / 100);
}

TEST_CASE("concentric, coaxial and parallel bodies of revolution have narrow brackets", "[referee][width]") {
  const Shape ball = Sphere{0.5}, drum = Cylinder{1, 2}, rod = Cylinder{0.25, 3}, hat = Cone{1, 1},
              egg = Ellipsoid{{1, 1, 2}}, pill = Capsule{0.5, 1};
  const auto gap = [](const Shape& a, const Pose& p, const Shape& b, const Pose& q) {
    const Bracket g = judge_pair({&a, p}, {&b, q}).gap;
    REQUIRE(g.hi - g.lo <= 1e-14);
    return 0.5 * (g.lo + g.hi);
  };
  const Pose here{};
  const Quat upside_down{1, 0, 0, 0}, tilted{0.1, 0.2, 0.3, 0.9};
  REQUIRE(gap(drum, here, ball, here) == Approx(-1.5).epsilon(1e-15));
  REQUIRE(gap(drum, here, rod, here) == Approx(-1.25).epsilon(1e-15));
  REQUIRE(gap(drum, here, rod, {{0, 0, 0}, upside_down}) == Approx(-1.25).epsilon(1e-15));
  REQUIRE(gap(drum, {{0, 0, 0}, tilted}, rod, {{0, 0, 0}, tilted}) == Approx(-1.25).epsilon(1e-15));
  REQUIRE(gap(drum, here, rod, {{0.5, 0, 0}, {}}) == Approx(-0.75).epsilon(1e-15));
  REQUIRE(gap(drum, here, pill, here) == Approx(-1.5).epsilon(1e-15));
  REQUIRE(gap(pill, here, drum, {{0, 0, 0}, {0, 0, 1, 0}}) == Approx(-1.5).epsilon(1e-15));
  // Cone of half angle atan(1/2) about its own axis and a ball centred on the axis: the slant at distance
  // (1-0)/√5.
  REQUIRE(gap(hat, here, ball, here) == Approx(-0.5 - 1 / std::sqrt(5.0)).epsilon(1e-15));
  REQUIRE(gap(egg, here, ball, here) == Approx(-1.5).epsilon(1e-15));
  REQUIRE(gap(egg, here, egg, here) == Approx(-2).epsilon(1e-15));
}

TEST_CASE("swapping the bodies mirrors the answer", "[referee][relation]") {
  Rng r(8);
  int cases = 0;
  for (int i = 0; i < 1500; ++i) {
    const Shape sa = random_convex(r, tested_kinds[r.below(7)]),
                sb = random_convex(r, tested_kinds[r.below(7)]);
    const Placed a{&sa, Pose{Vec3::Zero(), r.rotation()}},
        b{&sb, Pose{r.uniform(0, 2) * r.unit_vector(), r.rotation()}};
    const PairTruth t = judge_pair(a, b), u = judge_pair(b, a);
    REQUIRE(std::max(t.gap.lo, u.gap.lo) <= std::min(t.gap.hi, u.gap.hi));  // both contain the truth
    if (t.verdict != Verdict::undecided && u.verdict != Verdict::undecided) REQUIRE(t.verdict == u.verdict);
    ++cases;
  }
  REQUIRE(cases == 1500);
}

TEST_CASE("hints are tried and never trusted", "[referee]") {
  Rng r(15);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  int cases = 0;
  for (int i = 0; i < 500; ++i) {
    const Shape sa = random_convex(r, tested_kinds[r.below(4)]),
                sb = random_convex(r, tested_kinds[r.below(4)]);
    const Placed a{&sa, Pose{Vec3::Zero(), r.rotation()}},
        b{&sb, Pose{r.uniform(0, 2) * r.unit_vector(), r.rotation()}};
    const PairTruth plain = judge_pair(a, b);
    const std::vector<Vec3> directions{Vec3(nan, 0, 0), Vec3::Zero(), r.unit_vector(), -plain.normal,
                                       plain.normal};
    const std::vector<Vec3> points{Vec3(nan, 0, 0), r.unit_vector(), Vec3(1e300, 0, 0)};
    const PairTruth hinted = judge_pair(a, b, directions, points);
    REQUIRE(hinted.verdict == plain.verdict);
    REQUIRE(hinted.gap.lo <= plain.gap.hi);
    REQUIRE(plain.gap.lo <= hinted.gap.hi);
    ++cases;
  }
  REQUIRE(cases == 500);
}

TEST_CASE("the outer box holds the body and is tight to rounding", "[referee]") {
  Rng r(21);
  int cases = 0;
  for (int i = 0; i < 2000; ++i) {
    const Shape s = random_convex(r, tested_kinds[r.below(7)]);
    const Pose p{r.unit_vector() * 10, r.rotation()};
    const Aabb box = outer_box({&s, p});
    for (int k = 0; k < 3; ++k) {
      const double top = world_support(s, p, Vec3::Unit(k))[k],
                   bottom = world_support(s, p, -Vec3::Unit(k))[k];
      REQUIRE(std::abs(box.hi[k] - top) <= 1e-14);
      REQUIRE(std::abs(box.lo[k] - bottom) <= 1e-14);
    }
    ++cases;
  }
  const Shape half = HalfSpace{{0, 0, -2}, 4};
  const Aabb h = outer_box({&half, Pose{}});
  REQUIRE(h.lo.z() == -2);
  REQUIRE(h.hi.z() == std::numeric_limits<double>::infinity());
  REQUIRE(cases == 2000);
}

// A whole arc of directions is equally good: for an inner polytope alone the brackets were 1e-6 wide.
TEST_CASE("brackets are narrow where a feature lies on the axis of a body of revolution",
          "[referee][width]") {
  Rng r(77);
  for (int i = 0; i < 40; ++i) {
    const double radius = r.uniform(0.5, 2), half = r.uniform(1, 3), at = r.uniform(-0.2, 0.2);
    const Pose placed{r.unit_vector(), Quat{}};
    // The end of a capsule that lies across, and a corner of a flat hull.
    const double reach = r.uniform(0.1, 0.4);
    const Shape cylinder = Cylinder{radius, 2 * radius + half}, capsule = Capsule{reach, half};
    const Shape cone = Cone{radius, 2 * half},
                tip = make_hull({Vec3(0, 0, at), Vec3(3, 0, at), Vec3(3, 2, at)});
    const Pose across{placed.translation + Vec3(half, 0, at), Quat{0, 1, 0, 1}};
    INFO(i);
    const PairTruth t = judge_pair({&cylinder, placed}, {&capsule, across});
    CHECK(t.gap.hi - t.gap.lo <= 1e-14 * (half + radius));
    CHECK(t.gap.lo <= -(radius + reach) * (1 - 1e-15));
    CHECK(t.gap.hi >= -(radius + reach) * (1 + 1e-15));

    const PairTruth c = judge_pair({&cone, placed}, {&tip, placed});
    const double depth = (2 * half - at) * radius / std::sqrt(radius * radius + 16 * half * half);
    CHECK(c.gap.hi - c.gap.lo <= 1e-14 * (half + radius));
    CHECK(c.gap.lo <= -depth * (1 - 1e-14));
    CHECK(c.gap.hi >= -depth * (1 + 1e-14));
  }
}
