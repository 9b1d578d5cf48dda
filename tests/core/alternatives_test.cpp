// The alternatives to a time of impact find what they promise and miss what they are known to miss.
#include "core/impact/alternatives.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {
const Shape ball = Sphere{0.25}, wall = Box{{0.125, 4, 4}};
MovingShape shot(double from, double travel) {
  return {&ball, {Vec3(from, 0, 0), {}}, {Vec3(travel, 0, 0), Vec3::Zero()}};
}
const MovingShape still{&wall, {}, {}};
}  // namespace

TEST_CASE("alternatives: the end pose finds what ends in contact and nothing else", "[alternatives]") {
  CHECK(end_pose_impact(shot(-2, 2), still).toi == 1.0);
  CHECK_FALSE(end_pose_impact(shot(-2, 4), still).toi);
  CHECK_FALSE(end_pose_impact(shot(0, 4), still).toi);  // not even what it left
}

TEST_CASE("alternatives: sub-steps find a pass when one of them falls within it", "[alternatives]") {
  // In contact from 13/32 to 19/32 of the step.
  CHECK_FALSE(substep_impact(shot(-2, 4), still, 1).toi);
  CHECK(substep_impact(shot(-2, 4), still, 2).toi == 0.5);
  CHECK_FALSE(substep_impact(shot(-2.5, 4), still, 2).toi);
  CHECK(substep_impact(shot(-2, 4), still, 32).toi == 13.0 / 32);
  CHECK(substep_impact(shot(-2, 4), still, 1024).toi == 13.0 / 32);
  CHECK(substep_impact(shot(0, 4), still, 4).toi == 0.0);
  CHECK(substep_impact(shot(-2, 4), still, 0).outcome == Outcome::invalid_input);
  CHECK(substep_impact(shot(-2, 4), still, 32).steps == 14);
}

TEST_CASE("alternatives: a speculative contact is right head on, a ghost in passing, blind beyond its margin",
          "[alternatives]") {
  CHECK(speculative_impact(shot(-2, 4), still, 1).toi.value() == Approx(13.0 / 32));
  CHECK_FALSE(speculative_impact(shot(-2, 4), still, 0.25).toi);
  CHECK_FALSE(speculative_impact(shot(-2, 1), still, 1).toi);
  CHECK_FALSE(speculative_impact(shot(2, 4), still, 1).toi);
  CHECK(speculative_impact(shot(0, 4), still, 1).toi == 0.0);
  // Past a corner: the nearest points approach each other although the bodies never meet.
  const Shape cube = Box{{1, 1, 1}};
  const MovingShape passing{&cube, {Vec3(-4, -2.25, 0), {}}, {Vec3(8, 0, 0), Vec3::Zero()}},
      block{&cube, {}, {}};
  CHECK_FALSE(time_of_impact(passing, block).toi);
  CHECK(speculative_impact(passing, block, 1).toi);
}

TEST_CASE("alternatives: sub-steps are never before the time of impact, and more of them miss less",
          "[alternatives][random]") {
  long hits = 0, found[3] = {0, 0, 0};
  constexpr int counts[3] = {1, 16, 256};
  for (std::uint64_t i = 0; i < 300; ++i) {
    Rng r = Rng::stream(61, i);
    const Pair p = random_pair(r, static_cast<ShapeKind>(r.below(7)), static_cast<ShapeKind>(r.below(7)),
                               Regime::separate);
    const Vec3 d = p.pose_b.translation - p.pose_a.translation;
    const MovingShape a{&p.a, p.pose_a, {d * r.uniform(1, 3) + r.unit_vector() * 0.2, r.unit_vector()}},
        b{&p.b, p.pose_b, {}};
    const ImpactAnswer truth = time_of_impact(a, b);
    hits += truth.toi.has_value();
    for (std::size_t k = 0; k < 3; ++k) {
      const ImpactAnswer x = substep_impact(a, b, counts[k]);
      REQUIRE(x.outcome == Outcome::answered);
      found[k] += x.toi.has_value();
      if (x.toi && truth.toi) CHECK(*x.toi >= *truth.toi - 1e-9);
    }
  }
  CAPTURE(hits, found[0], found[1], found[2]);
  CHECK(hits > 60);
  CHECK(found[0] < found[1]);
  CHECK(found[1] <= found[2]);
  CHECK(found[2] <= hits + 1);
}
