// The criterion of "swept only where needed": inner extents against support functions, and the claimed depth
// of unseen passes against dense samples.
#include "core/world/sweep_criterion.h"
#include "core/narrow/pair_table.h"
#include "core/tolerance.h"
#include "tests/core/least_width.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;

TEST_CASE("criterion: known inner extents", "[sweep]") {
  const auto of = [](const Shape& s) { return inner_extent(s); };
  CHECK(of(Sphere{0.5}).inner == Approx(0.5));
  CHECK(of(Box{{1, 0.25, 2}}).inner == Approx(0.25));
  CHECK(of(Capsule{0.5, 3}).inner == Approx(0.5));
  CHECK(of(Cylinder{2, 0.125}).inner == Approx(0.125));
  CHECK(of(Ellipsoid{{1, 0.5, 2}}).inner == Approx(0.5));
  // A right-angled triangle's cone: half base 3, height 4, side 5.
  CHECK(of(Cone{3, 2}).inner == Approx(1.5));
  CHECK(of(Cone{3, 2}).about_origin == Approx(1.2));
  const Shape tetrahedron = make_hull({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
  CHECK(of(tetrahedron).inner == Approx(1 / std::sqrt(3.0)).epsilon(1e-5));
  CHECK(of(make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})).inner == 0);
  CHECK(of(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}).inner == 0);
  CHECK(std::isinf(of(HalfSpace{}).inner));
  // A hull that does not contain its origin: its nearest vertex; the ball is at its middle.
  const Shape away = make_hull({{5, -1, -1}, {5, 1, -1}, {5, 0, 1}, {7, 0, 0}});
  CHECK(of(away).about_origin == Approx(-std::sqrt(26.0)));
  CHECK(of(away).inner > 0.3);
}

TEST_CASE("criterion: in every direction the balls lie inside and the reach outside", "[sweep][random]") {
  long checked = 0, solid = 0;
  for (std::uint64_t i = 0; i < 700; ++i) {
    Rng r = Rng::stream(41, i);
    const Shape s = random_shape(r, static_cast<ShapeKind>(i % 7), r.chance(0.3));
    const InnerExtent e = inner_extent(s);
    solid += e.inner > 0;
    for (int k = 0; k < 200; ++k, ++checked) {
      const WideVec n = r.unit_vector().cast<Wide>().normalized();
      REQUIRE(height_along(s, n) >= e.about_origin - std::abs(e.about_origin) * 0x1p-50);
      REQUIRE(height_along(s, n) + height_along(s, -n) >= 2 * e.inner * (1 - 0x1p-50));
      REQUIRE(height_along(s, n) <= e.reach * (1 + 0x1p-50));
    }
  }
  CAPTURE(checked);
  CHECK(solid > 400);
}

TEST_CASE("criterion: what passes unseen is no deeper than claimed", "[sweep][random]") {
  long passes = 0, turning_passes = 0, pairs = 0;
  double nearest = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Rng r = Rng::stream(43, i);
    const auto ka = static_cast<ShapeKind>(r.below(7)),
               kb = static_cast<ShapeKind>(r.below(r.chance(0.1) ? 8 : 7));
    Pair p = random_pair(r, ka, kb, Regime::separate);
    if (kind_of(p.a) == ShapeKind::half_space) {
      std::swap(p.a, p.b);
      std::swap(p.pose_a, p.pose_b);
    }
    const bool plane = kind_of(p.b) == ShapeKind::half_space;
    // Aimed to meet in the middle of the step; in turn translating, rotating on the spot, or both.
    const Vec3 d = p.pose_b.translation - p.pose_a.translation;
    Motion ma, mb;
    if (i % 3 != 1) ma.linear = d * 2 + r.unit_vector() * r.uniform(0, 0.5);
    if (i % 3 != 0) ma.angular = r.unit_vector() * r.uniform(0, 8);
    if (!plane && i % 5 == 0) mb = {r.unit_vector() * r.uniform(0, 1), r.unit_vector() * r.uniform(0, 3)};
    if (i % 3 == 1 || plane) {
      aim(p, r.uniform(0, 0.05));
      if (r.chance(0.5)) std::swap(ma.linear, mb.angular);
      mb = plane ? Motion{} : mb;
    }
    const auto gap = [&](double t) {
      return static_cast<double>(
          narrow::separate(p.a, wide_frame_at(p.pose_a, ma, t), p.b, wide_frame_at(p.pose_b, mb, t)).gap);
    };
    ++pairs;
    if (gap(0) <= 0 || gap(1) <= 0) continue;
    double deepest = 0;
    for (int k = 1; k < 40; ++k) deepest = std::max(deepest, -gap(k / 40.0));
    if (deepest == 0) continue;
    ++passes;
    turning_passes += ma.linear.isZero(0);
    const InnerExtent ea = inner_extent(p.a), eb = inner_extent(p.b);
    const double bound = pass_bound(ea, ma, eb, mb), tau = tolerance::core_tau_factor * 0x1p-53 * scale_of(p);
    CAPTURE(i, deepest, bound);
    REQUIRE(deepest <= bound + tau);
    nearest = std::max(nearest, deepest / bound);
    // What is not swept is at most `share` of a pass through the middle; and the bodies' flags cover the
    // pair.
    for (const double share : {0.25, 0.5, 1.0}) {
      const double middle = ea.inner + (plane ? 0 : eb.inner);
      if (!needs_sweep(ea, ma, eb, mb, share))
        REQUIRE(deepest <= share * middle + tau);
      else if (!plane)
        REQUIRE((is_flagged(ea, ma, share) || is_flagged(eb, mb, share)));
    }
  }
  CAPTURE(pairs, passes, turning_passes, nearest);
  CHECK(passes > 150);
  CHECK(turning_passes > 5);
  CHECK(nearest > 0.3);
}

TEST_CASE("criterion: motion side by side, spinning balls and half-spaces need no sweep", "[sweep]") {
  const InnerExtent ball = inner_extent(Sphere{0.01}), rod = inner_extent(Capsule{0.01, 1}),
                    ground = inner_extent(HalfSpace{}), wall = inner_extent(Box{{3, 3, 3}});
  const Motion fast{Vec3(50, 0, 0), Vec3::Zero()}, spin{Vec3::Zero(), Vec3(0, 90, 0)}, rest;
  CHECK(is_flagged(ball, fast, 0.5));
  CHECK(needs_sweep(ball, fast, wall, rest, 0.5));
  CHECK_FALSE(needs_sweep(ball, fast, ball, fast, 0.5));
  CHECK_FALSE(is_flagged(ball, spin, 0.5));
  CHECK(is_flagged(rod, spin, 0.5));
  CHECK_FALSE(needs_sweep(rod, spin, wall, rest, 0.5));  // 1 of reach against 3 of wall: seen
  CHECK(needs_sweep(rod, spin, ball, rest, 0.5));
  CHECK_FALSE(needs_sweep(ball, fast, ground, rest, 0.5));
  CHECK(needs_sweep(rod, spin, ground, rest, 0.5));
}
