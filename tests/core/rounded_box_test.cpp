// Rounded boxes in the core: against the referee, and against the shapes that they degenerate to.
#include "core/impact/impact.h"
#include "core/narrow/narrow_phase.h"
#include "core/tolerance.h"
#include "core/world/simpler_shape.h"
#include "core/world/sweep_criterion.h"
#include "oracles/referee/referee.h"
#include "scenarios/random/family.h"
#include "tests/core/box_bounds.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

double tau_of(const Scene& s) { return tolerance::core_tau_factor * 0x1p-53 * scale_of_pair(s, 0, 1); }

struct Pair {
  explicit Pair(Scene scene) : s(std::move(scene)) {}
  PlacedShape core(int i) const { return {&s.shape_of(i), s.bodies[static_cast<std::size_t>(i)].pose}; }
  Placed placed(int i) const { return {&s.shape_of(i), s.bodies[static_cast<std::size_t>(i)].pose}; }
  Motion motion(int i) const { return s.bodies[static_cast<std::size_t>(i)].motion.value_or(Motion{}); }
  Scene s;
};

struct Tally {
  int apart = 0, overlapping = 0, hits = 0, misses = 0;
};

void check_at_rest(const Pair& p, Tally& n) {
  const referee::PairTruth t = referee::judge_pair(p.placed(0), p.placed(1));
  const double tau = tau_of(p.s);
  REQUIRE(t.verdict != referee::Verdict::undecided);
  const DistanceAnswer d = distance(p.core(0), p.core(1));
  const ContactAnswer c = contact(p.core(0), p.core(1));
  REQUIRE(d.outcome == Outcome::answered);
  REQUIRE(c.outcome == Outcome::answered);
  const bool clear = t.gap.lo > tau || t.gap.hi < -tau;
  if (clear) CHECK(c.overlap == (t.verdict == referee::Verdict::overlap));
  if (clear) CHECK(overlap(p.core(0), p.core(1)).overlap == c.overlap);
  ++(t.verdict == referee::Verdict::overlap ? n.overlapping : n.apart);
  if (!is_convex(kind_of(p.s.shape_of(0))) || !is_convex(kind_of(p.s.shape_of(1)))) return;
  CHECK(d.distance >= t.gap.lo - tau - (d.distance < 0 ? c.regret_bound : 0));
  CHECK(d.distance <= t.gap.hi + tau);
  if (c.overlap) CHECK(std::abs(referee::width(p.placed(0), p.placed(1), c.normal).hi - c.depth) <= tau);
}

void check_in_motion(const Pair& p, Tally& n) {
  const Placed a = p.placed(0), b = p.placed(1);
  const Motion ma = p.motion(0), mb = p.motion(1);
  const double tau = tau_of(p.s);
  const ImpactAnswer x =
      time_of_impact({p.core(0).shape, p.core(0).pose, ma}, {p.core(1).shape, p.core(1).pose, mb});
  REQUIRE(x.outcome == Outcome::answered);
  const double until = x.toi.value_or(1);
  ++(x.toi ? n.hits : n.misses);
  if (until > 0) CHECK(referee::certified_depth_before(a, ma, b, mb, until) <= tau);
  if (x.toi) CHECK(referee::gap_at(a, ma, b, mb, until).lo <= tau);
}

}  // namespace

TEST_CASE("rounded boxes and padded shapes: distance, contact and time of impact agree with the referee",
          "[core][rounded][padded]") {
  const std::string family = GENERATE("later", "padded");
  Tally n;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Case c = fuzz::make_case(5, i, family);
    INFO(c.id);
    const Pair p(c.scene);
    if (c.scene.bodies[1].motion || c.scene.bodies[0].motion)
      check_in_motion(p, n);
    else
      check_at_rest(p, n);
  }
  CHECK(n.apart > 500);
  CHECK(n.overlapping > 400);
  CHECK(n.hits > 200);
  CHECK(n.misses > 10);
}

TEST_CASE("a rounded box is a box, a ball or a capsule where its sizes are zero", "[core][rounded]") {
  const RoundedBox sharp{{1, 2, 3}, 0}, ball{{0, 0, 0}, 2}, rod{{0, 3, 0}, 2}, real{{1, 2, 3}, 0.5};
  CHECK(simpler_shape(sharp, 0)->shape == Shape(Box{{1, 2, 3}}));
  CHECK(simpler_shape(ball, 0)->shape == Shape(Sphere{2}));
  CHECK_FALSE(simpler_shape(real, 1).has_value());
  const auto capsule = simpler_shape(rod, 0);
  REQUIRE(capsule);
  CHECK(capsule->shape == Shape(Capsule{2, 3}));
  CHECK(capsule->error == 0);
  CHECK(to_transform(capsule->in_body) * Vec3(0, 0, 3) == Vec3(0, 3, 0));
  const auto along_x = simpler_shape(RoundedBox{{3, 0, 0}, 2}, 0);
  CHECK(to_transform(along_x->in_body) * Vec3(0, 0, 3) == Vec3(3, 0, 0));
  CHECK(simpler_shape(rod, 1.6)->shape == Shape(Sphere{3.5}));
  Rng r(7);
  for (int i = 0; i < 300; ++i) {
    const Pose p{Vec3::Zero(), r.rotation()}, q{r.unit_vector() * r.uniform(2, 8), r.rotation()};
    const Shape other = Cylinder{1, 0.5};
    for (const Shape& s : {Shape(sharp), Shape(ball), Shape(rod)}) {
      const SimplerShape simple = *simpler_shape(s, 0);
      const double x = distance({&s, p}, {&other, q}).distance;
      const double y = distance({&simple.shape, placed_in(p, simple.in_body)}, {&other, q}).distance;
      CHECK(x == Approx(y).margin(1e-13));
    }
  }
}

TEST_CASE("the boxes and balls of a rounded box", "[core][rounded]") {
  Rng r(8);
  const Shape s = RoundedBox{{1, 2, 3}, 0.5};
  CHECK(bounding_radius(s) >= std::sqrt(14.0) + 0.5);
  CHECK(bounding_radius(s) <= std::sqrt(14.0) + 0.5 + 1e-14);
  CHECK(extent(s) == 3.5);
  CHECK(inner_extent(s).inner == Approx(1.5));
  CHECK(inner_extent(s).inner <= 1.5);
  testing::check_boxes(r, s, 200);
}
