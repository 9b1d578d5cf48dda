// Ladders: one difficulty raised rung by rung, for every pair of convex shapes, judged by the referee. Runs
// every other rung; TOUCHSTONE_NARROW_ROUNDS=n climbs all of them n times, with other sizes each time.
#include <cstdlib>

#include "core/tolerance.h"
#include "oracles/referee/referee.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"
#include "tests/support/plain_shape.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

long extra_rounds() {
  const char* text = std::getenv("TOUCHSTONE_NARROW_ROUNDS");
  return text ? std::max(1L, std::atol(text)) : 0;
}

Shape plain_shape(Rng& rng, ShapeKind kind) {
  return test::plain_shape(rng, kind, [](Rng& r, auto&& size) {
    std::vector<Vec3> v;
    for (int i = 0; i < 12; ++i) v.push_back(r.unit_vector() * size());
    return make_hull(std::move(v));
  });
}

Pair plain_pair(Rng& r, ShapeKind a, ShapeKind b) {
  Pair p{plain_shape(r, a), plain_shape(r, b), {}, {}};
  p.pose_a.rotation = r.rotation();
  p.pose_b.rotation = r.rotation();
  p.pose_b.translation = 3 * r.unit_vector();
  return p;
}

struct Tally {
  long cases = 0, overlaps = 0, undecided = 0;
};

double outside(double x, double lo, double hi) { return std::max({lo - x, x - hi, 0.0}); }

// Judges each answer by what it claims, as in truth.md §3.
void judge(const Pair& p, Tally& t) {
  const Placed a{&p.a, p.pose_a}, b{&p.b, p.pose_b};
  const referee::PairTruth truth = referee::judge_pair(a, b);
  const double tau = tolerance::core_tau_factor * 0x1p-53 * scale_of(p);
  const bool decided = truth.verdict != referee::Verdict::undecided;
  const bool overlapping = truth.verdict == referee::Verdict::overlap;
  const double least = std::min(std::abs(truth.gap.lo), std::abs(truth.gap.hi));
  ++t.cases;
  t.overlaps += overlapping;
  t.undecided += !decided;

  const OverlapAnswer o = overlap(p.placed_a(), p.placed_b());
  REQUIRE(o.outcome == Outcome::answered);
  if (decided && least > tau) CHECK(o.overlap == overlapping);

  const DistanceAnswer d = distance(p.placed_a(), p.placed_b());
  REQUIRE(d.outcome == Outcome::answered);
  CHECK(outside(d.distance, truth.gap.lo, truth.gap.hi) <= tau);
  CHECK(std::abs((d.witness[1] - d.witness[0]).norm() - std::abs(d.distance)) <= tau);
  CHECK(referee::distance_to(a, d.witness[0]).lo <= tau);
  CHECK(referee::distance_to(b, d.witness[1]).lo <= tau);

  const ContactAnswer c = contact(p.placed_a(), p.placed_b());
  REQUIRE(c.outcome == Outcome::answered);
  if (decided && least > tau) CHECK(c.overlap == overlapping);
  if (!c.overlap) return;
  const referee::Bracket w = referee::width(a, b, c.normal);
  CHECK(outside(c.depth, w.lo, w.hi) <= tau);
  CHECK(w.lo + truth.gap.lo <= tau);
  CHECK_FALSE(c.manifold.empty());
  for (const ContactPoint& m : c.manifold) {
    CHECK(referee::distance_to(a, m.position).lo <= c.depth + tau);
    CHECK(referee::distance_to(b, m.position).lo <= c.depth + tau);
  }
}

// f(rng, pair, exponent) builds the rung; exponents run from `from` to `to`.
template <class F>
Tally climb(int from, int to, std::uint64_t seed, F&& f) {
  Tally t;
  const long rounds = extra_rounds();
  for (long round = 0; round < std::max(1L, rounds); ++round)
    for (int a = 0; a < 7; ++a)
      for (int b = a; b < 7; ++b)
        for (int k = from; k <= to; ++k) {
          Rng r = Rng::stream(seed, static_cast<std::uint64_t>(((round * 7 + a) * 7 + b) * 64 + (k + 32)));
          Pair p = plain_pair(r, static_cast<ShapeKind>(a), static_cast<ShapeKind>(b));
          f(r, p, k);
          INFO(type_name(p.a) << " " << type_name(p.b) << " rung 1e" << k << " round " << round);
          judge(p, t);
        }
  INFO(t.cases << " cases, " << t.overlaps << " overlap, " << t.undecided << " undecided by the referee");
  CHECK(t.cases > 0);
  CHECK(t.undecided * 4 < t.cases);
  return t;
}

double signed_gap(Rng& r, double size) { return r.chance(0.5) ? size : -size; }

void aim_twice(Pair& p, double gap) {
  for (int i = 0; i < 3; ++i) aim(p, gap);
}

}  // namespace

TEST_CASE("ladder of the gap, 1e-1 to 1e-16", "[narrow][ladder]") {
  const Tally t =
      climb(-16, -1, 31, [](Rng& r, Pair& p, int k) { aim_twice(p, signed_gap(r, std::pow(10.0, k))); });
  CHECK(t.overlaps > t.cases / 4);
}

TEST_CASE("ladder of the scale, 1e-6 to 1e6", "[narrow][ladder]") {
  climb(-6, 6, 32, [](Rng& r, Pair& p, int k) {
    aim_twice(p, signed_gap(r, 0.03));
    const double s = std::pow(10.0, k);
    scale_shape(p.a, s);
    scale_shape(p.b, s);
    p.pose_b.translation *= s;
  });
}

TEST_CASE("ladder of the offset, 1 to 1e8", "[narrow][ladder]") {
  climb(0, 8, 33, [](Rng& r, Pair& p, int k) {
    aim_twice(p, signed_gap(r, 0.03));
    const Vec3 offset = r.unit_vector() * std::pow(10.0, k);
    p.pose_a.translation += offset;
    p.pose_b.translation += offset;
  });
}

TEST_CASE("ladder of the aspect, 1 to 1e6", "[narrow][ladder]") {
  climb(-6, 0, 34, [](Rng& r, Pair& p, int k) {
    // One size of A shrinks; for a hull, one coordinate of every vertex.
    const double s = std::pow(10.0, k);
    if (auto* x = std::get_if<Box>(&p.a)) x->half_extents.x() *= s;
    if (auto* x = std::get_if<Capsule>(&p.a)) x->radius *= s;
    if (auto* x = std::get_if<Cylinder>(&p.a)) (r.chance(0.5) ? x->radius : x->half_height) *= s;
    if (auto* x = std::get_if<Cone>(&p.a)) (r.chance(0.5) ? x->radius : x->half_height) *= s;
    if (auto* x = std::get_if<Ellipsoid>(&p.a)) x->semi_axes.x() *= std::max(s, 1e-3);
    if (auto* x = std::get_if<Hull>(&p.a)) {
      auto v = x->vertices;
      for (Vec3& q : v) q.x() *= s;
      p.a = make_hull(std::move(v));
    }
    aim_twice(p, signed_gap(r, 0.01 * s));
  });
}

TEST_CASE("ladder of the angle from parallel, 1e-1 to 1e-16", "[narrow][ladder]") {
  climb(-16, -1, 35, [](Rng& r, Pair& p, int k) {
    p.pose_b.rotation = p.pose_a.rotation;
    const Vec3 axis = r.unit_vector() * (0.5 * std::pow(10.0, k));
    p.pose_b.rotation = Quat{axis.x(), axis.y(), axis.z(), 1} * p.pose_a.rotation;
    p.pose_b.translation =
        rotation_matrix(p.pose_a.rotation) * Vec3(r.uniform(-0.3, 0.3), r.uniform(-0.3, 0.3), 3);
    aim_twice(p, signed_gap(r, 0.02));
  });
}
