// Bodies of simple sizes turned by whole turns of the lattice: many touch exactly. The verdict of a curved
// pair that touches at a point with simple coordinates is decided, with a point that the checker accepts.
#include "oracles/referee/checker.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {
namespace {

double eighths(Rng& r, int lo, int hi) {
  return (lo + static_cast<int>(r.below(static_cast<std::uint64_t>(hi - lo + 1)))) / 8.0;
}

Shape lattice_shape(Rng& r) {
  const double x = eighths(r, 2, 8), y = eighths(r, 2, 8), z = eighths(r, 2, 8);
  switch (r.below(6)) {
    case 0:
      return Sphere{x};
    case 1:
      return Box{{x, y, z}};
    case 2:
      return Capsule{x, y};
    case 3:
      return Cylinder{x, y};
    case 4:
      return Cone{x, y};
    default:
      return Ellipsoid{{x, y, z}};
  }
}

Quat quarter_turn(Rng& r) {
  const Quat turns[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}, {1, 0, 0, 0}};
  return turns[r.below(6)];
}

}  // namespace

TEST_CASE("exact contact of curved bodies on a lattice is decided", "[referee][touching]") {
  Rng r(71);
  int touching = 0, undecided = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const Shape x = lattice_shape(r), y = lattice_shape(r);
    Pose px, py;
    px.rotation = quarter_turn(r), py.rotation = quarter_turn(r);
    // Axis by axis boxes that share a face: the bodies touch there more often than not.
    const Placed at_origin{&y, py};
    const Aabb box_a = outer_box({&x, px}), box_b = outer_box(at_origin);
    const int k = static_cast<int>(r.below(3));
    py.translation[k] = std::round(64 * (box_a.hi[k] - box_b.lo[k])) / 64;
    const Placed a{&x, px}, b{&y, py};
    const PairTruth t = judge_pair(a, b);
    undecided += t.verdict == Verdict::undecided;
    if (t.verdict != Verdict::overlap || t.gap.lo < -1e-9) continue;
    ++touching;
    REQUIRE(check(checkable_certificate(t, a, b), a, b));
    REQUIRE(t.gap.hi <= 0);
  }
  CAPTURE(touching, undecided);
  REQUIRE(touching > n / 3);
  CHECK(undecided <= n / 200);
}

TEST_CASE("a body half a billionth of a unit away is not talked into contact", "[referee][touching]") {
  Rng r(73);
  int apart = 0;
  for (int i = 0; i < 600; ++i) {
    const double radius = eighths(r, 2, 8), half = eighths(r, 2, 8);
    const Shape drum = Cylinder{radius, half}, ball = Sphere{1};
    const double gap = std::ldexp(1.0, -30 - static_cast<int>(r.below(20)));
    Pose p;
    p.translation = {radius + 1 + gap, 0, half / 2};
    if (p.translation.x() == radius + 1) continue;
    const PairTruth t = judge_pair({&drum, Pose{}}, {&ball, p});
    REQUIRE(t.verdict == Verdict::disjoint);
    ++apart;
  }
  REQUIRE(apart == 600);
}

}  // namespace touchstone::referee_test
