// One step of a whole scene: nothing that is swept tunnels, and only what the criterion allows is left
// unswept.
#include "core/world/step_world.h"

#include <algorithm>
#include <cmath>

#include "oracles/referee/referee.h"
#include "tests/bench/tunnel_scene.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::bench;

namespace {

constexpr SweepOptions discrete{SweepOptions::Which::none, 0.5}, everything{SweepOptions::Which::all, 0.5};

bool reports(const StepReport& r, int a, int b) {
  return std::any_of(r.impacts.begin(), r.impacts.end(), [&](const PairImpact& x) {
    return x.a == std::min(a, b) && x.b == std::max(a, b) && x.impact.toi;
  });
}
bool touches_at_end(const StepReport& r, int a, int b) {
  return std::any_of(r.contacts.begin(), r.contacts.end(),
                     [&](const PairContact& c) { return c.a == std::min(a, b) && c.b == std::max(a, b); });
}

Scene two_bodies(Shape a, Vec3 from, Motion m, Shape b) {
  Scene s;
  s.shapes = {std::move(a), std::move(b)};
  s.bodies.resize(2);
  s.bodies[0].pose.translation = from;
  s.bodies[0].motion = m;
  s.bodies[1].shape = 1;
  s.bodies[1].is_static = true;
  return s;
}

}  // namespace

TEST_CASE("step: a bullet is flagged and hits the wall that its end pose is behind", "[step]") {
  const Scene s = two_bodies(Sphere{0.01}, {-1, 0, 0}, {Vec3(3, 0, 0), Vec3::Zero()}, Box{{0.002, 1, 1}});
  StepWorld w(s);
  const StepReport r = w.step();
  REQUIRE(r.swept.size() == 1);
  CHECK(r.swept[0].body == 0);
  CHECK(r.swept[0].reason == SweepReason::travel);
  CHECK(r.swept[0].pass_bound == Approx(1.5));
  REQUIRE(r.impacts.size() == 1);
  CHECK(*r.impacts[0].impact.toi == Approx((1 - 0.012) / 3));
  CHECK(r.asked == 1);
  const StepReport end_only = StepWorld(s).step(discrete);
  CHECK(end_only.contacts.empty());
  CHECK(end_only.impacts.empty());
  CHECK(end_only.swept.empty());
}

TEST_CASE("step: a slow body is swept on request, and a rod because of its rotation", "[step]") {
  const Scene slow =
      two_bodies(Sphere{0.5}, {0, 0, 0.55}, {Vec3(0.2, 0, 0), Vec3::Zero()}, Box{{0.1, 0.1, 0.1}});
  StepWorld w(slow);
  CHECK(w.step().swept.empty());
  w.flag(0, true);
  const StepReport r = w.step();
  REQUIRE(r.swept.size() == 1);
  CHECK(r.swept[0].reason == SweepReason::by_hand);
  CHECK(r.asked == 1);
  w.flag(0, false);
  CHECK(w.step().swept.empty());
  // A rod sweeps a quarter circle through a bead.
  const Shape rod = Capsule{0.01, 1};
  const Scene turning = two_bodies(rod, {0, 0, 0}, {Vec3::Zero(), Vec3(0, 1.5, 0)}, Sphere{0.01});
  Scene t = turning;
  t.bodies[1].pose.translation = Vec3(std::sin(0.7), 0, std::cos(0.7)) * 0.9;
  const StepReport x = StepWorld(t).step();
  REQUIRE(x.swept.size() == 1);
  CHECK(x.swept[0].reason == SweepReason::turning);
  CHECK(reports(x, 0, 1));
  CHECK(x.contacts.empty());
}

TEST_CASE("step: a bullet hits a slow body where that was at the start of the step", "[step]") {
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      CAPTURE(axis, sign);
      const Vec3 e = sign * Vec3::Unit(axis), across = Vec3::Unit((axis + 1) % 3);
      // The box retreats by 0.2; at its end pose the bullet's path passes 0.1 in front of it.
      Scene s =
          two_bodies(Sphere{0.01}, 0.61 * e - 3 * across, {6 * across, Vec3::Zero()}, Box{{0.5, 0.5, 0.5}});
      s.bodies[1].is_static = false;
      s.bodies[1].pose.translation = 0.2 * e;
      s.bodies[1].motion = Motion{-0.2 * e, Vec3::Zero()};
      StepWorld w(s);
      const StepReport r = w.step();
      REQUIRE(r.swept.size() == 1);
      CHECK(r.swept[0].body == 0);
      CHECK(reports(r, 0, 1));
    }
}

TEST_CASE("step: poses carry over from step to step", "[step]") {
  StepWorld w(two_bodies(Sphere{0.1}, {-1, 0, 0}, {Vec3(0.1, 0, 0), Vec3::Zero()}, Box{{0.05, 1, 1}}));
  int steps = 0;
  while (w.step().contacts.empty() && steps < 20) {
    w.accept();
    ++steps;
  }
  CHECK(steps == 8);  // at -1 + 0.1·9 = -0.1: overlaps; at -0.2 it does not
  w.set(0, Pose{Vec3(-0.5, 0, 0), {}}, Motion{});
  const StepReport r = w.step();
  CHECK(r.contacts.empty());
  CHECK(w.end_pose(0).translation.x() == -0.5);
}

TEST_CASE("step: among a thousand bodies the bullets are flagged and nothing tunnels", "[step][tunnel]") {
  const TunnelScene t = tunnel_scene(1000, 7);
  StepWorld world(t.scene), end_only(t.scene);
  Rng r(8);
  long passes = 0, unseen_by_discrete = 0, asked = 0;
  std::vector<long> others_flagged;
  constexpr int steps = 6;
  for (int step = 0; step < steps; ++step) {
    const auto fired = shots(t, r);
    for (int i = 0; i < t.bullets; ++i)
      for (StepWorld* w : {&world, &end_only})
        w->set(i, fired[static_cast<std::size_t>(i)].start, fired[static_cast<std::size_t>(i)].motion);
    const StepReport x = world.step(), y = end_only.step(discrete);
    REQUIRE(x.outcome == Outcome::answered);
    asked += x.asked;
    long others = 0;
    std::vector<char> flagged(1000, 0);
    for (const SweptBody& b : x.swept) {
      flagged[static_cast<std::size_t>(b.body)] = 1;
      others += b.body >= t.bullets;
      if (b.body < t.bullets) CHECK(b.reason == SweepReason::travel);
    }
    others_flagged.push_back(others);
    for (int i = 0; i < t.bullets; ++i) REQUIRE(flagged[static_cast<std::size_t>(i)]);
    // Every bullet against everything, by the referee.
    const Scene& now = world.scene();
    for (int i = 0; i < t.bullets; ++i)
      for (int j = 0; j < 1000; ++j) {
        if (j == i) continue;
        const Body &a = now.bodies[static_cast<std::size_t>(i)], &b = now.bodies[static_cast<std::size_t>(j)];
        const Motion ma = a.motion.value_or(Motion{}), mb = b.motion.value_or(Motion{});
        const Placed pa{&now.shape_of(i), a.pose}, pb{&now.shape_of(j), b.pose};
        if (!overlaps(referee::outer_box(pa, ma), referee::outer_box(pb, mb))) continue;
        const auto truth = referee::judge_motion(pa, ma, pb, mb);
        REQUIRE(truth.verdict != referee::TimeTruth::Verdict::undecided);
        const bool hit = truth.verdict == referee::TimeTruth::Verdict::hit;
        CAPTURE(step, i, j);
        REQUIRE(reports(x, i, j) == hit);
        passes += hit;
        unseen_by_discrete += hit && !touches_at_end(y, i, j);
      }
    world.accept();
    end_only.accept();
  }
  CAPTURE(passes, unseen_by_discrete, asked);
  CHECK(passes > steps);
  CHECK(unseen_by_discrete > passes / 2);
  CHECK(*std::max_element(others_flagged.begin(), others_flagged.end()) <= 10);
}

TEST_CASE("step: what only a full sweep finds is as shallow as the criterion promises", "[step][random]") {
  // Faster and denser: many flagged bodies, so that the path through a broad phase is taken too.
  TunnelScene t = tunnel_scene(400, 11);
  Rng r(12);
  for (Body& b : t.scene.bodies)
    if (b.motion && r.chance(0.3)) b.motion->linear *= 30;
  StepWorld by_criterion(t.scene), all(t.scene);
  const StepReport x = by_criterion.step(), y = all.step(everything);
  REQUIRE(x.swept.size() > 24);
  REQUIRE(x.swept.size() < y.swept.size());
  CHECK(x.spared > 0);
  CHECK(x.asked < y.asked);
  long found = 0, left = 0;
  for (const PairImpact& i : y.impacts) {
    const auto at = [&](int k) -> const Body& { return t.scene.bodies[static_cast<std::size_t>(k)]; };
    if (reports(x, i.a, i.b)) {
      ++found;
      continue;
    }
    if (touches_at_end(y, i.a, i.b) || *i.impact.toi == 0) continue;
    ++left;
    const InnerExtent ea = inner_extent(t.scene.shape_of(i.a)), eb = inner_extent(t.scene.shape_of(i.b));
    const Placed pa{&t.scene.shape_of(i.a), at(i.a).pose}, pb{&t.scene.shape_of(i.b), at(i.b).pose};
    const double depth = referee::certified_depth_before(pa, at(i.a).motion.value_or(Motion{}), pb,
                                                         at(i.b).motion.value_or(Motion{}), 1);
    CHECK(depth <= 0.5 * (ea.inner + eb.inner));
  }
  CAPTURE(found, left);
  CHECK(found > 20);
  for (const PairImpact& i : x.impacts) CHECK(reports(y, i.a, i.b));
}
