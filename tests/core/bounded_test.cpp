// Questions about a limit.
#include "core/narrow/bounded.h"

#include <cmath>
#include <limits>

#include "oracles/referee/referee.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

struct Pair {
  PlacedShape a, b;
  referee::PairTruth truth;
};

// Pairs of the default mix that are asked about at rest.
template <class F>
void for_each_pair(std::uint64_t cases, F&& f) {
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Case c = fuzz::make_case(77, i);
    if (c.queries.empty() || c.queries[0].question > Question::contact) continue;
    const Query& q = c.queries[0];
    const auto body = [&](int k) -> const Body& { return c.scene.bodies[static_cast<std::size_t>(k)]; };
    const Placed x{&c.scene.shape_of(q.a), body(q.a).pose}, y{&c.scene.shape_of(q.b), body(q.b).pose};
    f(Pair{{x.shape, body(q.a).pose}, {y.shape, body(q.b).pose}, referee::judge_pair(x, y)},
      scale_of_pair(c.scene, q.a, q.b));
  }
}

constexpr double tau = 128 * 0x1p-53;  // of L

}  // namespace

TEST_CASE("a lower bound of the distance is below it", "[core][bounded]") {
  int useful = 0, bounds = 0;
  for_each_pair(3000, [&](const Pair& p, double) {
    const double bound = distance_lower_bound(p.a, p.b);
    REQUIRE(!std::isnan(bound));
    if (!std::isfinite(p.truth.gap.hi) || std::isinf(p.truth.gap.lo)) return;
    REQUIRE(bound <= p.truth.gap.hi);
    ++bounds;
    useful += bound > 0;
  });
  CHECK(bounds > 1000);
  CHECK(useful > 100);
}

TEST_CASE("a bound is exact for spheres up to its rounding", "[core][bounded]") {
  const Shape ball = Sphere{0.5};
  const double bound = distance_lower_bound({&ball, Pose{}}, {&ball, {{3, 4, 0}, {}}});
  CHECK(bound <= 4);
  CHECK(bound > 4 - 1e-12);
}

TEST_CASE("a distance is given up to the limit, and a bound beyond it", "[core][bounded]") {
  int farther = 0, measured = 0;
  for_each_pair(3000, [&](const Pair& p, double l) {
    if (std::isinf(p.truth.gap.lo)) return;
    const DistanceAnswer plain = distance(p.a, p.b);
    if (plain.outcome != Outcome::answered) return;
    for (const double limit : {p.truth.gap.lo - 0.25 * l, p.truth.gap.lo, p.truth.gap.hi + 0.25 * l}) {
      const BoundedDistanceAnswer r = distance(p.a, p.b, limit);
      REQUIRE(r.outcome == Outcome::answered);
      REQUIRE(r.lower_bound <= p.truth.gap.hi + tau * l);
      if (r.distance) {
        REQUIRE(r.distance->distance == plain.distance);
        ++measured;
      } else {
        REQUIRE(r.lower_bound > limit);
        ++farther;
      }
    }
  });
  CHECK(farther > 300);
  CHECK(measured > 1000);
}

TEST_CASE("whether bodies are within a margin, apart and overlapping", "[core][bounded]") {
  int yes = 0, no = 0;
  for_each_pair(2000, [&](const Pair& p, double l) {
    if (std::isinf(p.truth.gap.lo)) return;
    for (const double margin : {p.truth.gap.lo - 4 * tau * l, p.truth.gap.hi + 4 * tau * l}) {
      const WithinAnswer r = within(p.a, p.b, margin);
      if (r.outcome != Outcome::answered) continue;
      REQUIRE(r.within == (margin > p.truth.gap.hi));
      ++(r.within ? yes : no);
    }
  });
  CHECK(yes > 500);
  CHECK(no > 500);
}

TEST_CASE("the boundary of a margin belongs to it", "[core][bounded]") {
  const Shape box = Box{{1, 1, 1}};
  const PlacedShape a{&box, Pose{}};
  const PlacedShape beside{&box, {{2.5, 0, 0}, {}}}, corner{&box, {{2.375, 2.5, 0}, {}}};
  CHECK(within(a, beside, 0.5).within);
  CHECK(!within(a, beside, std::nextafter(0.5, 0)).within);
  CHECK(within(a, corner, 0.625).within);
  CHECK(!within(a, corner, std::nextafter(0.625, 0)).within);
  const PlacedShape deep{&box, {{1.5, 0, 0}, {}}};
  CHECK(within(a, deep, -0.5).within);
  CHECK(!within(a, deep, -0.500001).within);
  const PlacedShape touching{&box, {{2, 0, 0}, {}}};
  CHECK(within(a, touching, 0).within);
}

TEST_CASE("half-spaces have no bound along a line and are measured", "[core][bounded]") {
  const Shape plane = HalfSpace{{0, 0, 1}, 0}, ball = Sphere{0.5};
  const PlacedShape ground{&plane, Pose{}}, above{&ball, {{0, 0, 4}, {}}};
  CHECK(distance_lower_bound(ground, above) == -std::numeric_limits<double>::infinity());
  const BoundedDistanceAnswer r = distance(ground, above, 1);
  REQUIRE(r.distance);
  CHECK(r.distance->distance == 3.5);
  CHECK(!within(ground, above, 1).within);
}

TEST_CASE("a contact within a margin: the verdict of within, the normal and minus the distance",
          "[core][bounded]") {
  int apart = 0, overlapping = 0, beyond = 0;
  for_each_pair(2000, [&](const Pair& p, double l) {
    const DistanceAnswer d = distance(p.a, p.b);
    if (d.outcome != Outcome::answered || is_mesh(*p.a.shape) || is_mesh(*p.b.shape)) return;
    for (const double more : {-0.25, 0.25, 2.0}) {
      const double margin = d.distance + more * std::abs(d.distance);
      const ContactAnswer r = contact_within(p.a, p.b, margin);
      REQUIRE(r.outcome == Outcome::answered);
      if (margin != 0) REQUIRE(r.overlap == within(p.a, p.b, margin).within);
      if (!r.overlap) {
        ++beyond;
        CHECK(r.manifold.empty());
        continue;
      }
      (d.distance > 0 ? apart : overlapping) += 1;
      CHECK(std::abs(r.depth + d.distance) <= 4 * tau * l);
      REQUIRE(!r.manifold.empty());
      for (const ContactPoint& x : r.manifold) {
        CHECK(x.depth <= r.depth + 4 * tau * l);
        CHECK(x.depth >= -margin - 4 * tau * l);
      }
    }
  });
  CHECK(apart > 500);
  CHECK(overlapping > 500);
  CHECK(beyond > 500);
}

TEST_CASE("boxes apart by less than a margin have the corners of the region between their faces",
          "[core][bounded]") {
  const Shape floor = Box{{4, 4, 1}}, box = Box{{1, 0.5, 1}};
  const double gap = 0.125;
  const Pose above{{0.25, 0, 2 + gap}, {}};
  const ContactAnswer level = contact_within({&floor, Pose{}}, {&box, above}, 0.25);
  REQUIRE(level.manifold.size() == 4);
  CHECK(level.normal == Vec3(0, 0, 1));
  for (const ContactPoint& p : level.manifold) {
    CHECK(p.depth == -gap);
    CHECK(std::abs(p.position.z() - (1 + gap / 2)) < 1e-15);
    CHECK(std::abs(std::abs(p.position.x() - 0.25) - 1) < 1e-15);
    CHECK(std::abs(std::abs(p.position.y()) - 0.5) < 1e-15);
  }
  // Leaning by 0.1: the lower two corners are within the smaller margin.
  const Quat lean{0, std::sin(0.05), 0, std::cos(0.05)};
  const double low = std::sin(0.1), rise = 2 * std::sin(0.1);
  const Pose leaning{{0, 0, 1 + gap + std::cos(0.1) + low}, lean};
  const auto near = [&](double margin) {
    return contact_within({&floor, Pose{}}, {&box, leaning}, margin).manifold;
  };
  CHECK(near(gap / 2).empty());
  CHECK(near(gap + rise / 2).size() == 2);
  const Manifold all = near(gap + rise + 0.01);
  REQUIRE(all.size() == 4);
  double least = 1, most = -1;
  for (const ContactPoint& p : all) {
    least = std::min(least, p.depth);
    most = std::max(most, p.depth);
  }
  CHECK(std::abs(most + gap) < 1e-12);
  CHECK(std::abs(least + gap + rise) < 1e-12);
}
