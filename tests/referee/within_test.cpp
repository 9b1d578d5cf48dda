// judge_within against closed forms in rational numbers, at margins that are the gap rounded to a double and
// its neighbours.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "oracles/referee/exact/rational.h"
#include "tests/referee/separating_axis.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;

namespace {

Verdict within(const Placed& a, const Placed& b, double margin) {
  return judge_within(a, b, margin, judge_pair(a, b));
}

Verdict of(bool is_within) { return is_within ? Verdict::overlap : Verdict::disjoint; }

std::array<double, 5> about(double x) {
  const double up = std::nextafter(x, HUGE_VAL), down = std::nextafter(x, -HUGE_VAL);
  return {std::nextafter(down, -HUGE_VAL), down, x, up, std::nextafter(up, HUGE_VAL)};
}

Pose at(const Vec3& t) { return {t, {}}; }

Rational squared(const Rational& x) { return x * x; }

// sqrt(square) - radii <= margin
bool reaches(const Rational& square, const Rational& radii, double margin) {
  const Rational reach = exact(margin) + radii;
  return reach >= 0 && square <= squared(reach);
}

}  // namespace

TEST_CASE("within a margin: spheres, to the last bit, apart and overlapping", "[referee][within]") {
  Rng rng(1);
  int yes = 0, no = 0;
  for (int i = 0; i < 2000; ++i) {
    const double ra = rng.uniform(0.1, 1), rb = rng.uniform(0.1, 1), x = rng.uniform(0.1, 3);
    const Shape a = Sphere{ra}, b = Sphere{rb};
    for (const double margin : about(x - ra - rb)) {
      const bool expected = exact(x) - exact(ra) - exact(rb) <= exact(margin);
      REQUIRE(within({&a, at({0, 0, 0})}, {&b, at({x, 0, 0})}, margin) == of(expected));
      ++(expected ? yes : no);
    }
  }
  CHECK(yes > 3000);
  CHECK(no > 3000);
}

TEST_CASE("within a margin: corners of boxes and rounded boxes, to the last bit", "[referee][within]") {
  Rng rng(2);
  int yes = 0, no = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 h{rng.uniform(0.1, 1), rng.uniform(0.1, 1), rng.uniform(0.1, 1)};
    const Vec3 t{h.x() + rng.uniform(1, 2), h.y() + rng.uniform(1, 2), h.z() + rng.uniform(1, 2)};
    const double radius = i % 2 == 0 ? 0 : rng.uniform(0.1, 0.4);
    const Shape a = radius > 0 ? Shape(RoundedBox{h, radius}) : Shape(Box{h}), b = Box{{0.5, 0.5, 0.5}};
    Rational square = 0;
    for (int k = 0; k < 3; ++k) square += squared(exact(t[k]) - exact(h[k]) - exact(0.5));
    const double gap = (t - h - Vec3::Constant(0.5)).norm() - radius;
    for (const double margin : about(gap)) {
      const bool expected = reaches(square, exact(radius), margin);
      REQUIRE(within({&a, at({0, 0, 0})}, {&b, at(t)}, margin) == of(expected));
      REQUIRE(within({&b, at(t)}, {&a, at({0, 0, 0})}, margin) == of(expected));
      ++(expected ? yes : no);
    }
  }
  CHECK(yes > 1500);
  CHECK(no > 1500);
}

TEST_CASE("within a negative margin: depths of boxes, to the last bit", "[referee][within]") {
  Rng rng(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 h{rng.uniform(0.5, 1), rng.uniform(0.5, 1), rng.uniform(0.5, 1)};
    const Vec3 t{rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)};
    const Shape a = Box{h}, b = Box{{0.5, 0.5, 0.5}};
    Rational depth = exact(100.0);
    for (int k = 0; k < 3; ++k) depth = std::min(depth, exact(h[k]) + exact(0.5) - exact(std::abs(t[k])));
    for (const double margin : about(-depth.convert_to<double>()))
      REQUIRE(within({&a, at({0, 0, 0})}, {&b, at(t)}, margin) == of(-depth <= exact(margin)));
  }
}

TEST_CASE("within a negative margin: turned polytopes agree with the separating-axis test",
          "[referee][within]") {
  Rng rng(4);
  int deep = 0, shallow = 0;
  for (int i = 0; i < 600; ++i) {
    const Placed3 x = random_polytope(rng), y = random_polytope(rng);
    const Slow slow = judge_slowly(x.world, y.world, x.scale, y.scale);
    if (slow.disjoint) continue;
    const Placed a{&x.shape, x.pose}, b{&y.shape, y.pose};
    const auto depth = static_cast<double>(slow.depth);
    // A margin beyond the referee's bracket of the gap needs no exact test; one that equals it does.
    for (const double margin : {-depth - 0.125, -depth + 0.125, -depth}) {
      const Verdict v = within(a, b, margin);
      if (margin == -depth && depth > 0) {
        // The depth is irrational or rounded, except where it is a short double.
        if (std::ldexp(depth, 10) == std::floor(std::ldexp(depth, 10))) REQUIRE(v == Verdict::overlap);
        continue;
      }
      const bool expected = static_cast<long double>(margin) >= -slow.depth;
      REQUIRE(v == of(expected));
      ++(expected ? deep : shallow);
    }
  }
  CHECK(deep > 100);
  CHECK(shallow > 100);
}

TEST_CASE("within a margin: half-spaces, to the last bit, apart and overlapping", "[referee][within]") {
  Rng rng(5);
  const Shape plane = HalfSpace{{1, 2, 2}, 0};  // a normal of length 3
  for (int i = 0; i < 500; ++i) {
    const double r = rng.uniform(0.1, 1), h = rng.uniform(-1, 1);
    const Shape ball = Sphere{r};
    const Vec3 t(h, h / 2, -h / 4);
    const Rational along = (exact(t.x()) + 2 * exact(t.y()) + 2 * exact(t.z())) / 3;
    for (const double margin : about((t.x() + 2 * t.y() + 2 * t.z()) / 3 - r)) {
      const bool expected = along - exact(r) <= exact(margin);
      REQUIRE(within({&plane, at({0, 0, 0})}, {&ball, at(t)}, margin) == of(expected));
      REQUIRE(within({&ball, at(t)}, {&plane, at({0, 0, 0})}, margin) == of(expected));
    }
  }
}

TEST_CASE("within a margin: the nearest triangle of a mesh, and no depth of one", "[referee][within]") {
  TriangleMesh m;
  m.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}};
  m.triangles = {{3, 4, 5}, {0, 1, 2}};
  const Shape mesh = m, ball = Sphere{0.25};
  const Pose above = at({0.25, 0.25, 1});
  for (const double margin : about(0.75))
    CHECK(within({&mesh, at({0, 0, 0})}, {&ball, above}, margin) == of(margin >= 0.75));
  const Pose through = at({0.25, 0.25, 0.125});
  CHECK(within({&mesh, at({0, 0, 0})}, {&ball, through}, 0) == Verdict::overlap);
  CHECK(within({&mesh, at({0, 0, 0})}, {&ball, through}, -0.0625) == Verdict::undecided);
  CHECK(within({&mesh, at({0, 0, 0})}, {&ball, above}, -0.0625) == Verdict::disjoint);
}

TEST_CASE("within a margin: curved bodies at a margin that is their gap", "[referee][within]") {
  const Shape cylinder = Cylinder{0.5, 1}, cone = Cone{0.5, 1};
  const Placed a{&cylinder, at({0, 0, 0})};
  CHECK(within(a, {&cylinder, at({1.75, 0, 0})}, 0.75) == Verdict::overlap);
  CHECK(within(a, {&cone, at({0, 0, 2.5})}, 0.5) == Verdict::overlap);
  CHECK(within(a, {&cylinder, at({1.75, 0, 0})}, 0.7499999) == Verdict::disjoint);
  CHECK(within(a, {&cylinder, at({0.75, 0, 0})}, -0.2499) == Verdict::overlap);
  CHECK(within(a, {&cylinder, at({0.75, 0, 0})}, -0.2501) == Verdict::disjoint);
}

TEST_CASE("within a margin of any size is monotone, and agrees with the bracket of the gap",
          "[referee][within]") {
  Rng rng(6);
  for (int i = 0; i < 400; ++i) {
    const Shape x = random_convex(rng, tested_kinds[rng.below(std::size(tested_kinds))]);
    const Shape y = random_convex(rng, tested_kinds[rng.below(std::size(tested_kinds))]);
    const Quat turned = rng.rotation();
    const Placed a{&x, Pose{Vec3::Zero(), turned}};
    const Vec3 place = rng.vector(0, 2);
    const Placed b{&y, Pose{place, rng.rotation()}};
    const PairTruth t = judge_pair(a, b);
    Verdict before = Verdict::disjoint;
    for (const double margin : {-2.0, t.gap.lo - 1e-3, t.gap.lo, t.gap.hi, t.gap.hi + 1e-3, 3.0}) {
      const Verdict v = judge_within(a, b, margin, t);
      if (margin < t.gap.lo) REQUIRE(v == Verdict::disjoint);
      if (margin >= t.gap.hi) REQUIRE(v == Verdict::overlap);
      if (before == Verdict::overlap) REQUIRE(v == Verdict::overlap);
      if (margin >= t.gap.lo) before = v;
    }
  }
}
