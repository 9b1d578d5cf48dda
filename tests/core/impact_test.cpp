// Time of impact: closed forms, and never late against dense sampling.
#include <numbers>

#include "core/impact/impact.h"
#include "core/narrow/narrow_phase.h"
#include "core/narrow/pair_table.h"
#include "core/tolerance.h"
#include "tests/core/random_course.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {
Pose at(double x, double y, double z) { return {Vec3(x, y, z), {}}; }
Motion going(double x, double y, double z) { return {Vec3(x, y, z), Vec3::Zero()}; }
}  // namespace

TEST_CASE("impact: straight lines have the times of elementary geometry", "[impact]") {
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

TEST_CASE("impact: a mesh is hit at its first triangle, whichever of the two moves", "[impact][mesh]") {
  const Shape ball = Sphere{0.5},
              mesh = TriangleMesh{{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}, {-9, -9, 1}, {9, -9, 1}, {0, 9, 1}},
                                  {{0, 1, 2}, {3, 4, 5}}};
  const ImpactAnswer r = time_of_impact({&ball, at(0, 0, 5.5), going(0, 0, -8)}, {&mesh, {}, {}});
  REQUIRE(r.toi);
  CHECK(*r.toi == Approx(0.5).epsilon(1e-14));
  const ImpactAnswer s = time_of_impact({&ball, at(0, 0, 5.5), {}}, {&mesh, {}, going(0, 0, 8)});
  REQUIRE(s.toi);
  CHECK(*s.toi == Approx(0.5).epsilon(1e-13));
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

TEST_CASE("impact: translations are exact to tau, with points where the bodies meet", "[impact][random]") {
  using enum ShapeKind;
  const ShapeKind kinds[] = {sphere, capsule, box, hull};
  int cases = 0, hits = 0;
  for (std::uint64_t i = 0; i < 640; ++i) {
    Rng r = Rng::stream(4711, i);
    const Pair p = random_pair(r, kinds[i % 4], kinds[i / 4 % 4], Regime::separate);
    const Vec3 d = p.pose_b.translation - p.pose_a.translation;
    const Motion ma{d * r.uniform(0.4, 1.5) + r.unit_vector() * d.norm() * 0.3, Vec3::Zero()};
    const ImpactAnswer x = time_of_impact({&p.a, p.pose_a, ma}, {&p.b, p.pose_b, {}});
    REQUIRE(x.outcome == Outcome::answered);
    if (x.toi == 0.0) continue;
    ++cases;
    const auto gap = [&](Wide t) {
      return narrow::separate(p.a, wide_frame_at(p.pose_a, ma, t), p.b, wide_frame(p.pose_b)).gap;
    };
    const double l = scale_of(p) + ma.linear.norm(), tau = tolerance::core_tau_factor * 0x1p-53 * l;
    INFO("case " << i);
    for (int k = 0; k < 20; ++k) CHECK(static_cast<double>(gap(x.toi.value_or(1) * r.uniform())) >= -tau);
    if (!x.toi) continue;
    ++hits;
    CHECK(std::abs(static_cast<double>(gap(*x.toi))) <= tau);
    CHECK((x.witness_w[1] - x.witness_w[0]).norm() < 1e-8 * l);
    CHECK(x.normal_ab.norm() == Approx(1).epsilon(1e-12));
  }
  INFO(cases << " motions, " << hits << " hits");
  CHECK(hits > 0.3 * cases);
  CHECK(hits < 0.7 * cases);
}

TEST_CASE("impact: pairs that nearly touch at the start, or roll on each other, take few steps",
          "[impact][random]") {
  int most = 0, open = 0;
  for (std::uint64_t i = 0; i < 1200; ++i) {
    Rng r = Rng::stream(12 ^ 0x70f1, 6 * i + static_cast<std::uint64_t>(CourseKind::near_start));
    const CoursePair c = random_course(r, CourseKind::near_start);
    const ImpactAnswer x = time_of_impact({&c.p.a, c.p.pose_a, c.ma}, {&c.p.b, c.p.pose_b, c.mb});
    INFO("case " << i);
    REQUIRE(x.outcome == Outcome::answered);
    open += !x.toi || *x.toi > 0;
    most = std::max(most, x.steps);
  }
  CHECK(open > 200);
  // With fixed directions some of these need thousands.
  CHECK(most < 400);
}

TEST_CASE("impact: round bodies about one centre overlap, by a depth that separates them", "[impact]") {
  for (int i = 0; i < 40; ++i) {
    Rng r = Rng::stream(31, static_cast<std::uint64_t>(i));
    const auto kind =
        i % 3 == 0 ? ShapeKind::cylinder : (i % 3 == 1 ? ShapeKind::cone : ShapeKind::ellipsoid);
    const Shape a = random_shape(r, kind, false), b = random_shape(r, ShapeKind::ellipsoid, false);
    const Pose at_a{Vec3::Zero(), r.rotation()}, at_b{Vec3::Zero(), r.rotation()};
    const ImpactAnswer x = time_of_impact({&a, at_a, going(1, 0, 0)}, {&b, at_b, {}});
    REQUIRE(x.outcome == Outcome::answered);
    REQUIRE(x.toi);
    CHECK(*x.toi == 0);
    CHECK(x.separation < 0);
    // Moved slightly farther than the stated depth, they are apart.
    const Pose moved{x.normal_ab * (-x.separation * (1 + 1e-9)), at_b.rotation};
    CHECK_FALSE(overlap({&a, at_a}, {&b, moved}).overlap);
  }
}

TEST_CASE("impact: no motion, overlap from the start, spin without travel, many turns", "[impact]") {
  const Shape box = Box{{1, 1, 1}}, rod = Box{{2, 0.1, 0.1}}, ball = Sphere{0.5};
  const ImpactAnswer still = time_of_impact({&box, {}, {}}, {&box, at(2.5, 0, 0), {}});
  CHECK(still.outcome == Outcome::answered);
  CHECK_FALSE(still.toi);
  CHECK(still.clear_until == 1);
  CHECK(*time_of_impact({&box, {}, {}}, {&box, at(2, 0, 0), {}}).toi == 0);
  CHECK(*time_of_impact({&box, {}, {}}, {&box, at(2, 0, 0), going(1, 0, 0)}).toi == 0);
  CHECK(*time_of_impact({&box, {}, {Vec3::Zero(), Vec3(0, 0, 9)}}, {&ball, at(0.3, 0, 0), {}}).toi == 0);
  // The rod's tip, 2 from its axis, sweeps onto a ball whose edge is 1.5 away: sin(angle) where its side is.
  const Motion spin{Vec3::Zero(), Vec3(0, 0, std::numbers::pi / 2)};
  const ImpactAnswer side = time_of_impact({&rod, {}, spin}, {&ball, at(0, 1.9, 0), {}});
  REQUIRE(side.toi);
  CHECK(*side.toi < 1 - 0x1p-6);
  CHECK(*side.toi > 0.5);
  // Ninety turns, and contact only after all of them: the ball comes within reach at the end of the step.
  const Motion fast{Vec3::Zero(), Vec3(0, 0, 180 * std::numbers::pi)};
  const ImpactAnswer late = time_of_impact({&rod, {}, fast}, {&ball, at(3.5, 0, 0), going(-1, 0, 0)});
  REQUIRE(late.toi);
  // The corner of the rod is √4.01 from the axis.
  CHECK(*late.toi > 3 - std::sqrt(4.01) - 1e-12);
  CHECK(*late.toi < 3 - std::sqrt(4.01) + 0.01);
  CHECK_FALSE(time_of_impact({&rod, {}, fast}, {&ball, at(2.6, 0, 0), going(0, 0.1, 0)}).toi);
}

TEST_CASE("impact: sliding along a face is not a contact and does not end early", "[impact]") {
  const Shape box = Box{{1, 1, 1}}, floor = Box{{50, 50, 1}}, plane = HalfSpace{};
  for (const double gap : {1e-3, 1e-9, 1e-12}) {
    CHECK_FALSE(time_of_impact({&box, at(-20, 0, 2 + gap), going(40, 3, 0)}, {&floor, {}, {}}).toi);
    CHECK_FALSE(time_of_impact({&box, at(-20, 0, 1 + gap), going(40, 3, 0)}, {&plane, {}, {}}).toi);
    const ImpactAnswer turning =
        time_of_impact({&box, at(-20, 0, 2 + gap), {Vec3(40, 3, 0), Vec3(0, 0, 7)}}, {&floor, {}, {}});
    CHECK(turning.outcome == Outcome::answered);
    CHECK_FALSE(turning.toi);
  }
}

TEST_CASE("impact: speeds from 1e-9 to 1e9 sizes a step", "[impact]") {
  const Shape box = Box{{0.5, 0.5, 0.5}}, ball = Sphere{0.5},
              hull = make_hull({{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  for (const Shape* s : {&box, &ball, &hull})
    for (int e = -9; e <= 9; ++e)
      for (const double turn : {0.0, 1e-3}) {
        const double speed = std::pow(10, e), t = 0.75;
        // Towards a wall whose face is a gap of t·speed away.
        const Shape wall = Box{{1, 9 + speed, 9 + speed}};
        const double reach = s == &hull ? 1 : 0.5;
        const ImpactAnswer r = time_of_impact(
            {s, at(-1 - reach - t * speed, 0, 0), {Vec3(speed, 0, 0), Vec3(turn, 0, 0)}}, {&wall, {}, {}});
        INFO("speed " << speed << " turn " << turn);
        REQUIRE(r.outcome == Outcome::answered);
        REQUIRE(r.toi);
        const double l = std::max(9 + speed, 2.0);
        CHECK(std::abs(*r.toi - t) * speed <= tolerance::core_tau_factor * 0x1p-53 * 2 * l);
        CHECK(r.normal_ab.x() == Approx(1).epsilon(1e-9));
      }
}

TEST_CASE("impact: normal and points are those of the contact, from A to B", "[impact]") {
  const Shape box = Box{{1, 1, 1}}, ball = Sphere{0.5}, plane = HalfSpace{};
  for (const Vec3& spin : {Vec3(0, 0, 0), Vec3(0, 0, 1)}) {
    const ImpactAnswer r =
        time_of_impact({&ball, at(5, 0, 7), {Vec3(0, 0, -12), spin}}, {&box, at(5, 0, 0), {}});
    REQUIRE(r.toi);
    CHECK((r.normal_ab - Vec3(0, 0, -1)).norm() < 1e-12);
    for (const Vec3& x : r.witness_w) CHECK((x - Vec3(5, 0, 1)).norm() < 1e-12);
    const ImpactAnswer q =
        time_of_impact({&box, at(5, 0, 0), {}}, {&ball, at(5, 0, 7), {Vec3(0, 0, -12), spin}});
    CHECK((q.normal_ab + r.normal_ab).norm() < 1e-12);
  }
  const ImpactAnswer f = time_of_impact({&box, at(3, 4, 5), going(0, 0, -8)}, {&plane, {}, {}});
  REQUIRE(f.toi);
  CHECK((f.normal_ab - Vec3(0, 0, -1)).norm() < 1e-15);
  CHECK(std::abs(f.witness_w[0].z()) < 1e-13);
  const ImpactAnswer b = time_of_impact({&box, at(0.25, 0.5, 5), going(0, 0, -8)}, {&box, {}, {}});
  REQUIRE(b.toi);
  CHECK((b.normal_ab - Vec3(0, 0, -1)).norm() < 1e-15);
  for (const Vec3& x : b.witness_w)
    CHECK((std::abs(x.z() - 1) < 1e-13 && x.cwiseAbs().maxCoeff() < 1.5 + 1e-13));
}

TEST_CASE("impact: a mesh's tree does not change the answer", "[impact][mesh]") {
  TriangleMesh terrain;
  constexpr int n = 24;
  Rng g = Rng::stream(5, 5);
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) terrain.vertices.emplace_back(i - n / 2, k - n / 2, g.uniform(0, 0.8));
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const int v = i * (n + 1) + k;
      terrain.triangles.push_back({v, v + 1, v + n + 1});
      terrain.triangles.push_back({v + 1, v + n + 2, v + n + 1});
    }
  const Shape mesh = terrain;
  const Collider prepared(mesh);
  int hits = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    Rng r = Rng::stream(6, i);
    const Shape body = random_shape(r, static_cast<ShapeKind>(r.below(7)), false);
    const Pose pose{r.unit_vector() * 4 + Vec3(0, 0, 8), r.rotation()}, ground{Vec3(0, 0, 1), r.rotation()};
    const Motion m{Vec3(r.uniform(-4, 4), r.uniform(-4, 4), r.uniform(-14, -2)), r.vector(0, 5)};
    const ImpactAnswer with = time_of_impact({&body, pose, m}, prepared.at(ground, {}));
    const ImpactAnswer without = time_of_impact({&body, pose, m}, {&mesh, ground, {}});
    REQUIRE(with.outcome == Outcome::answered);
    CHECK(with.toi.has_value() == without.toi.has_value());
    if (!with.toi) continue;
    CHECK(*with.toi == Approx(*without.toi).epsilon(1e-12));
    if (*with.toi == 0) continue;  // any depth
    ++hits;
    const double gap = distance({&body, pose_at(pose, m, *with.toi)}, prepared.at(ground)).distance;
    CHECK(std::abs(gap) < 1e-12);
  }
  CHECK(hits > 15);
  CHECK(hits < 60);
}
