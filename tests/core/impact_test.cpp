// Time of impact: closed forms, and never late against dense sampling.
#include "core/ccd/impact.h"
#include "core/narrow/pair_table.h"
#include "core/tolerance.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {
Pose at(double x, double y, double z) { return {Vec3(x, y, z), {}}; }
Motion going(double x, double y, double z) { return {Vec3(x, y, z), Vec3::Zero()}; }
}  // namespace

TEST_CASE("impact: straight lines have the times of school geometry", "[impact]") {
  const Shape ball = Sphere{0.5}, box = Box{{0.5, 0.5, 0.5}}, ground = HalfSpace{},
              hull = make_hull({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(*time_of_impact({&ball, {}, going(8, 0, 0)}, {&ball, at(5, 0, 0), {}}).toi ==
        Approx(0.5).epsilon(4e-15));
  CHECK(*time_of_impact({&box, {}, going(8, 0, 0)}, {&box, at(5, 0, 0), {}}).toi ==
        Approx(0.5).epsilon(1e-14));
  CHECK(*time_of_impact({&ball, at(0, 0, 4.5), going(0, 0, -8)}, {&ground, {}, {}}).toi ==
        Approx(0.5).epsilon(1e-14));
  CHECK(*time_of_impact({&ground, {}, {}}, {&box, at(0, 0, 4.5), going(0, 0, -8)}).toi ==
        Approx(0.5).epsilon(1e-14));
  CHECK(*time_of_impact({&hull, {}, going(0, 0, 1)}, {&box, at(0, 0, 1.5), {}}).toi ==
        Approx(1).epsilon(2e-14));
  CHECK_FALSE(time_of_impact({&box, {}, going(0, 0, 1)}, {&box, at(0, 0, 2.0625), {}}).toi);
  CHECK(*time_of_impact({&box, {}, {}}, {&box, at(0.5, 0, 0), going(9, 0, 0)}).toi == 0);
  CHECK_FALSE(time_of_impact({&ball, {}, {}}, {&ball, at(2, 0, 0), {}}).toi);
  CHECK(*time_of_impact({&ball, {}, {}}, {&ball, at(1, 0, 0), {}}).toi == 0);
}

TEST_CASE("impact: a bullet does not tunnel, a graze within rounding is decided by the gap", "[impact]") {
  const Shape bullet = Sphere{0x1p-10}, wall = Box{{0x1p-12, 5, 5}};
  const ImpactAnswer hit = time_of_impact({&bullet, at(-500, 0, 0), going(1000, 0, 0)}, {&wall, {}, {}});
  REQUIRE(hit.toi);
  CHECK(*hit.toi == Approx((500 - 0x1p-10 - 0x1p-12) / 1000).epsilon(1e-14));
  CHECK_FALSE(time_of_impact({&bullet, at(-500, 5 + 0x1p-9, 0), going(1000, 0, 0)}, {&wall, {}, {}}).toi);
  const Shape rod = Capsule{0.125, 2};
  // The rod turns 80 times beside a wall that its tip misses by 1/16.
  const Pose beside{Vec3(2.1875 + 0x1p-12, 0, 0), {1, 0, 0, 1}};
  const ImpactAnswer spin = time_of_impact({&rod, beside, {Vec3::Zero(), Vec3(0, 0, 502)}}, {&wall, {}, {}});
  CHECK(spin.outcome == Outcome::answered);
  CHECK_FALSE(spin.toi);
}

TEST_CASE("impact: a mesh is hit at its first triangle; a moving mesh is unsupported", "[impact][mesh]") {
  const Shape ball = Sphere{0.5},
              mesh = TriangleMesh{{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}, {-9, -9, 1}, {9, -9, 1}, {0, 9, 1}},
                                  {{0, 1, 2}, {3, 4, 5}}};
  const ImpactAnswer r = time_of_impact({&ball, at(0, 0, 5.5), going(0, 0, -8)}, {&mesh, {}, {}});
  REQUIRE(r.toi);
  CHECK(*r.toi == Approx(0.5).epsilon(1e-14));
  CHECK(time_of_impact({&ball, {}, {}}, {&mesh, {}, going(1, 0, 0)}).outcome == Outcome::unsupported);
}

TEST_CASE("impact: never late, never early, never missed by more than tau, against dense samples",
          "[impact][random]") {
  long cases = 0, hits = 0, samples = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Rng r = Rng::stream(77, i);
    const auto ka = static_cast<ShapeKind>(r.below(7)), kb = static_cast<ShapeKind>(r.below(7));
    const Pair p = random_pair(r, ka, kb, Regime::separate);
    const Vec3 d = p.pose_b.translation - p.pose_a.translation;
    const Motion ma{d * r.uniform(0.4, 1.5) + r.unit_vector() * d.norm() * 0.1,
                    r.unit_vector() * r.uniform(0, 9)};
    const Motion mb{r.unit_vector() * d.norm() * r.uniform(0, 0.3), r.unit_vector() * r.uniform(0, 3)};
    const ImpactAnswer x = time_of_impact({&p.a, p.pose_a, ma}, {&p.b, p.pose_b, mb});
    REQUIRE(x.outcome == Outcome::answered);
    ++cases;
    const auto gap = [&](Wide t) {
      return narrow::separate(p.a, wide_frame_at(p.pose_a, ma, t), p.b, wide_frame_at(p.pose_b, mb, t)).gap;
    };
    const double tau =
        tolerance::core_tau_factor * 0x1p-53 * (scale_of(p) + ma.linear.norm() + mb.linear.norm());
    if (x.toi) {
      ++hits;
      if (*x.toi > 0) CHECK(std::abs(static_cast<double>(gap(*x.toi))) <= tau);
    }
    if (x.toi && *x.toi == 0) {
      CHECK(static_cast<double>(gap(0)) <= tau);
      continue;
    }
    for (int k = 0; k < 60; ++k, ++samples) {
      const Wide t = x.toi.value_or(1) * (k + r.uniform()) / 60;
      CHECK(static_cast<double>(gap(t)) >= -tau);
    }
  }
  INFO(cases << " motions, " << hits << " hits, " << samples << " samples");
  CHECK(hits > 0.3 * static_cast<double>(cases));
  CHECK(hits < 0.7 * static_cast<double>(cases));
}
