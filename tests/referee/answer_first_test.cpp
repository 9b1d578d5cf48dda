// Answer first: draws a tangent plane, a gap and a normal, and places the bodies on both sides of the plane,
// so that the answer is right by construction. The referee must never contradict it.
#include <cstdio>

#include "tests/referee/support.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {
namespace {

struct Answer {
  Shape a, b;
  Pose pose_a, pose_b;
  Vec3 normal;
  double gap;
  double error;  // of the gap, from rounding the construction: about 60 roundings of numbers of size L
};

double log_uniform(Rng& r, int lo, int hi) { return r.binary_scale(lo, hi); }

void finish(Answer& c) {
  const double l = scale_of(c.a, c.pose_a.translation, c.b, c.pose_b.translation) + std::abs(c.gap);
  c.error = 64 * 0x1p-53 * 4 * l;
}

// Support points facing each other at a distance: the plane between them shows that nothing is nearer.
Answer apart(Rng& r, int i) {
  Answer c{
      random_convex(r, tested_kinds[i % 7]), random_convex(r, tested_kinds[i / 7 % 7]), {}, {}, {}, 0, 0};
  c.pose_a.translation = r.vector(0, r.chance(0.2) ? 100 : 1);
  c.pose_a.rotation = r.rotation();
  c.pose_b.rotation = r.rotation();
  c.normal = r.unit_vector();
  c.gap = log_uniform(r, -40, 1);
  c.pose_b.translation =
      world_support(c.a, c.pose_a, c.normal) + c.gap * c.normal - world_support(c.b, c.pose_b, -c.normal);
  finish(c);
  return c;
}

// The centre of a ball outside A, above a support point: the depth is the radius minus the height.
Answer ball_in_side(Rng& r, int i) {
  const double radius = log_uniform(r, -4, 1);
  Answer c{random_convex(r, tested_kinds[i % 7]), Sphere{radius}, {}, {}, {}, 0, 0};
  c.pose_a.translation = r.vector(0, 2);
  c.pose_a.rotation = r.rotation();
  c.pose_b.rotation = r.rotation();
  c.normal = r.unit_vector();
  c.gap =
      -radius * (r.chance(0.5) ? std::ldexp(1.0, -static_cast<int>(r.below(40)) - 1) : r.uniform(0.01, 0.99));
  c.pose_b.translation = world_support(c.a, c.pose_a, c.normal) + (radius + c.gap) * c.normal;
  finish(c);
  return c;
}

// Two flat ends of boxes or cylinders pressed into each other by much less than the size of the bodies.
Answer faces(Rng& r, int i) {
  const auto prism = [&](bool box, double h) -> Shape {
    if (box) return Box{{r.uniform(0.5, 1), r.uniform(0.5, 1), h}};
    return Cylinder{r.uniform(0.5, 1), h};
  };
  const double ha = r.uniform(0.5, 1), hb = r.uniform(0.5, 1);
  Shape a = prism(i % 2 == 0, ha), b = prism(i % 4 < 2, hb);
  Answer c{std::move(a), std::move(b), {}, {}, {}, 0, 0};
  c.pose_a.rotation = c.pose_b.rotation = r.rotation();
  const Mat3 m = rotation_matrix(c.pose_a.rotation);
  c.normal = m.col(2);
  c.gap = (r.chance(0.5) ? -1 : 1) * log_uniform(r, -40, -5);
  c.pose_a.translation = r.vector(0, 1);
  const double sideways_x = r.uniform(-0.4, 0.4), sideways_y = r.uniform(-0.4, 0.4);
  c.pose_b.translation = c.pose_a.translation + m * Vec3(sideways_x, sideways_y, ha + hb + c.gap);
  finish(c);
  return c;
}

struct Count {
  int decided = 0, undecided = 0, overlapping = 0;
};

void hold_against(const Answer& c, Count& count) {
  const Placed a{&c.a, c.pose_a}, b{&c.b, c.pose_b};
  // With the right normal as a hint and without it: a hint may speed up the answer but never change it.
  const bool hinted = count.decided % 2 == 0;
  const PairTruth t =
      judge_pair(a, b, hinted ? std::span<const Vec3>(&c.normal, 1) : std::span<const Vec3>{});
  CAPTURE(type_name(c.a), type_name(c.b), c.gap, t.gap.lo, t.gap.hi, c.error);
  REQUIRE(t.gap.lo <= c.gap + c.error);
  REQUIRE(t.gap.hi >= c.gap - c.error);
  const Bracket w = width(a, b, c.normal);
  REQUIRE(w.lo <= -c.gap + c.error);
  REQUIRE(w.hi >= -c.gap - c.error);
  if (c.gap > c.error) REQUIRE(t.verdict != Verdict::overlap);
  if (c.gap < -c.error) REQUIRE(t.verdict != Verdict::disjoint);
  count.undecided += t.verdict == Verdict::undecided;
  count.overlapping += t.verdict == Verdict::overlap;
  ++count.decided;
}

Count run(std::uint64_t seed, int n) {
  Count count;
  for (int i = 0; i < n; ++i) {
    Rng r = Rng::stream(seed, static_cast<std::uint64_t>(i));
    const int family = i % 3;
    hold_against(family == 0   ? apart(r, i / 3)
                 : family == 1 ? ball_in_side(r, i / 3)
                               : faces(r, i / 3),
                 count);
  }
  return count;
}

}  // namespace

TEST_CASE("an answer that is right by construction is never contradicted", "[referee][answer-first]") {
  constexpr int n = 60000;
  const Count c = run(61, n);
  CAPTURE(c.decided, c.undecided, c.overlapping);
  REQUIRE(c.decided == n);
  CHECK(c.undecided <= n / 100);
  REQUIRE(c.overlapping > n * 3 / 10);
  REQUIRE(c.overlapping < n * 7 / 10);
}

TEST_CASE("a million answers that are right by construction are never contradicted", "[.million]") {
  constexpr int n = 1000000;
  const Count c = run(67, n);
  std::printf("%d answers, %d overlapping, %d undecided\n", c.decided, c.overlapping, c.undecided);
  REQUIRE(c.decided == n);
}

}  // namespace touchstone::referee_test
