// Times of impact of meshes that move, against the referee: two meshes, a mesh and a convex body, a mesh and
// a half-space. By hand with more: test_core_impact_meshes takes TOUCHSTONE_CASES as the number of cases.
#include <cstdlib>

#include "core/impact/impact.h"
#include "core/tolerance.h"
#include "oracles/referee/referee.h"
#include "tests/core/random_course.h"
#include "tests/core/random_meshes.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

struct Tally {
  int cases = 0, hits = 0, starts = 0, decided = 0;
};

// A random pair of meshes, the second taken away against a way through the first; or in B's place a convex
// body or a half-space.
CoursePair random_course_of_meshes(Rng& r) {
  CoursePair c;
  c.p = random_mesh_pair(r, static_cast<int>(r.below(mesh_regime_count)));
  const double size = extent(c.p.a) + extent(c.p.b);
  const auto kind = r.below(6);
  if (kind == 0) {
    c.p.b = random_shape(r, course::kind(r), false);
    scale_shape(c.p.b, size / 2);
  } else if (kind == 1) {
    c.p.b = HalfSpace{r.unit_vector(), r.uniform(-1, 1) * size};
    c.p.pose_b = {};
  }
  const Vec3 way = r.unit_vector() * size * r.uniform(0.5, 5);
  if (kind != 1) {
    c.p.pose_b.translation -= r.uniform(0, 0.9) * way + r.unit_vector() * size * r.uniform(0, 0.3);
    c.mb.linear = way;
  }
  c.ma.linear = kind == 1 ? way : r.unit_vector() * size * r.uniform(0, 0.5);
  if (r.chance(0.5)) c.ma.angular = r.vector(0.01, r.chance(0.3) ? 12 : 1);
  if (kind != 1 && r.chance(0.4)) c.mb.angular = r.vector(0.01, r.chance(0.3) ? 12 : 1);
  return c;
}

// Checks against the referee: the verdict, the gap at the time, the depth before it.
void check_course(const CoursePair& c, Tally& n) {
  using Verdict = referee::TimeTruth::Verdict;
  const Collider ca(c.p.a), cb(c.p.b);
  const ImpactAnswer x = time_of_impact(ca.at(c.p.pose_a, c.ma), cb.at(c.p.pose_b, c.mb));
  const Placed a{&c.p.a, c.p.pose_a}, b{&c.p.b, c.p.pose_b};
  const double tau = tolerance::core_tau_factor * 0x1p-53 * scale_of(c);
  REQUIRE(x.outcome == Outcome::answered);
  ++n.cases;
  n.hits += x.toi.has_value();
  n.starts += x.toi && *x.toi == 0;
  if (x.toi && *x.toi == 0) {
    CHECK(referee::gap_at(a, c.ma, b, c.mb, 0).lo <= tau);
    return;
  }
  const referee::TimeTruth truth = referee::judge_motion(a, c.ma, b, c.mb);
  n.decided += truth.verdict != Verdict::undecided;
  if (!x.toi) {
    CHECK(referee::certified_depth_before(a, c.ma, b, c.mb, 1) <= tau);
    return;
  }
  if (truth.verdict == Verdict::none) CHECK(truth.least_gap.lo <= tau);
  CHECK(referee::gap_at(a, c.ma, b, c.mb, *x.toi).lo <= tau);
  CHECK(referee::certified_depth_before(a, c.ma, b, c.mb, *x.toi) <= tau);
  if (truth.verdict == Verdict::hit) CHECK(x.clear_until <= truth.t_hi);
}

}  // namespace

TEST_CASE("impact: meshes that move meet when the referee says", "[impact][mesh][referee]") {
  const char* count = std::getenv("TOUCHSTONE_CASES");
  const int cases = count ? std::atoi(count) : 120;
  Tally n;
  for (int i = 0; i < cases; ++i) {
    Rng r = Rng::stream(77, static_cast<std::uint64_t>(i));
    INFO("case " << i);
    check_course(random_course_of_meshes(r), n);
  }
  INFO(n.cases << " motions, " << n.hits << " hits, " << n.starts << " at the start, " << n.decided
               << " decided");
  CHECK(n.hits - n.starts > 0.2 * n.cases);
  CHECK(n.hits < 0.9 * n.cases);
  CHECK(n.decided > 0.8 * (n.cases - n.starts));
}

TEST_CASE("impact: the order of two moving meshes does not matter", "[impact][mesh]") {
  for (std::uint64_t i = 0; i < 60; ++i) {
    Rng r = Rng::stream(78, i);
    const CoursePair c = random_course_of_meshes(r);
    const MovingShape a(&c.p.a, c.p.pose_a, c.ma), b(&c.p.b, c.p.pose_b, c.mb);
    const ImpactAnswer x = time_of_impact(a, b), y = time_of_impact(b, a);
    INFO("case " << i);
    CHECK(x.outcome == y.outcome);
    CHECK(x.toi.has_value() == y.toi.has_value());
    if (x.toi && y.toi) CHECK(std::abs(*x.toi - *y.toi) <= 1e-9);
  }
}

TEST_CASE("impact: a mesh that moves meets a mesh, a box and a half-space at the time of its way",
          "[impact][mesh]") {
  // A cube of half extent 1 that flies by 10 along x, 4 away from faces.
  const Shape cube = box_mesh({1, 1, 1}), wall = box_mesh({1, 5, 5}), box = Box{{1, 5, 5}},
              half = HalfSpace{-Vec3::UnitX(), -5};
  const Motion fly{{10, 0, 0}, Vec3::Zero()};
  for (const Shape* other : {&wall, &box, &half}) {
    const Pose at{{other == &half ? 0.0 : 6.0, 0, 0}, {}};
    const ImpactAnswer x = time_of_impact({&cube, {}, fly}, {other, at, {}});
    REQUIRE(x.toi);
    CHECK(std::abs(*x.toi - 0.4) <= 1e-14);
    CHECK((x.normal_ab - Vec3::UnitX()).norm() <= 1e-12);
    CHECK(std::abs(x.witness_w[0].x() - 5) <= 1e-12);
    CHECK_FALSE(time_of_impact({&cube, {}, {{3.9, 0, 0}, Vec3::Zero()}}, {other, at, {}}).toi);
  }
  // Both move, and one turns by a right angle about z: its corner leads.
  const ImpactAnswer both = time_of_impact({&cube, {}, {{5, 0, 0}, Vec3::Zero()}},
                                           {&wall, {{6, 0, 0}, {}}, {{-5, 0, 0}, Vec3::Zero()}});
  REQUIRE(both.toi);
  CHECK(std::abs(*both.toi - 0.4) <= 1e-14);
}
