// The depth along remembered features: it is found again after a small motion, and whatever is remembered, a
// depth that counts as proven is the least.
#include "core/narrow/filtered/recall.h"

#include "core/math/rng.h"
#include "core/narrow/narrow_phase.h"
#include "tests/core/narrow/convex_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;
using narrow::filtered::RecalledDepth;

namespace {

Shape random_polytope(Rng& r) {
  if (r.chance(0.3)) return Box{{r.uniform(0.3, 1), r.uniform(0.3, 1), r.uniform(0.3, 1)}};
  std::vector<Vec3> v;
  const int n = 8 + static_cast<int>(r.below(40));
  for (int i = 0; i < n; ++i) v.push_back(r.unit_vector().cwiseProduct(Vec3(1, 0.8, 0.6)));
  return make_hull(std::move(v));
}

/// B overlaps A by about `depth`.
ConvexPair overlapping_pair(Rng& r, double depth) {
  ConvexPair p{random_polytope(r), random_polytope(r), {3 * r.unit_vector(), r.rotation()}, {}};
  for (int step = 0; step < 3; ++step) {
    const Separation s = separation({&p.a, p.at_a}, {&p.b, p.at_b});
    p.at_b.translation -= (s.normal * (s.gap + static_cast<Wide>(depth))).cast<double>();
  }
  return p;
}

Pose moved(Rng& r, const Pose& p, double by) {
  const Vec3 turn = r.unit_vector() * (by / 2);
  return {p.translation + by * r.unit_vector(), Quat{turn.x(), turn.y(), turn.z(), 1} * p.rotation};
}

PairMemory memory_of(const ConvexPair& p) {
  PairMemory m;
  contact({&p.a, p.at_a}, {&p.b, p.at_b}, Arithmetic::float64, &m);
  return m;
}

/// Whether the depth is proven; if so, it is compared with the answer in extended precision.
bool is_found_again(const ConvexPair& p, const PairMemory& m) {
  const FilteredPair<double> f(p);
  const double tolerance = 16 * 0x1p-53 * f.size;
  const RecalledDepth<double> e(f.difference, m.features, m.direction, f.size, tolerance);
  if (!e.proven) return false;
  const Separation s = separation({&p.a, p.at_a}, {&p.b, p.at_b});
  REQUIRE(s.outcome == Outcome::answered);
  CHECK(std::abs(e.upper + static_cast<double>(s.gap)) <= 4 * tolerance);
  CHECK(e.lower <= e.upper);
  CHECK(std::abs(e.outward.norm() - 1) <= 0x1p-50);
  CHECK((e.w - e.upper * e.outward).norm() <= tolerance);
  // The points belong to the bodies: none is beyond a support plane.
  Rng directions(63);
  for (int k = 0; k < 20; ++k) {
    const Vec3 d = directions.unit_vector();
    CHECK(d.dot(e.a) <= d.dot(support_local<double>(f.a, d)) + tolerance);
  }
  return true;
}

}  // namespace

TEST_CASE("a depth is found again along the features that touched before a small motion", "[narrow][warm]") {
  int asked = 0, found = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    Rng r = Rng::stream(61, i);
    ConvexPair p = overlapping_pair(r, r.uniform(0.002, 0.006));
    // Two boxes keep no features: their axes are tested in less time.
    if (kind_of(p.a) == ShapeKind::box && kind_of(p.b) == ShapeKind::box) continue;
    const PairMemory m = memory_of(p);
    if (m.features.corner[0][0] < 0) continue;
    p.at_b = moved(r, p.at_b, 1e-3);
    INFO("case " << i);
    ++asked;
    found += is_found_again(p, m);
  }
  INFO(found << " of " << asked);
  CHECK(asked > 80);
  CHECK(found > 0.4 * asked);  // of the others, the features or the proof changed
}

TEST_CASE("a depth along stale or arbitrary features that counts as proven is the least", "[narrow][warm]") {
  int proven = 0, asked = 0;
  for (std::uint64_t i = 0; i < 1500; ++i) {
    Rng r = Rng::stream(62, i);
    ConvexPair p = overlapping_pair(r, r.uniform(0.0005, 0.05));
    PairMemory m = memory_of(p);
    if (i % 3 == 0) {
      for (auto& corners : m.features.corner)
        for (std::int32_t& k : corners) k = static_cast<std::int32_t>(r.below(60)) - 4;
      for (std::int32_t& k : m.features.opposite) k = static_cast<std::int32_t>(r.below(60)) - 4;
      if (r.chance(0.5)) m.direction = r.unit_vector();
    } else if (i % 3 == 1) {
      m = memory_of(overlapping_pair(r, 0.01));  // of another pair
    } else {
      p.at_b = moved(r, p.at_b, r.uniform(0.0005, 0.05));
    }
    INFO("case " << i);
    ++asked;
    proven += is_found_again(p, m);
  }
  INFO(proven << " of " << asked);
  CHECK(proven > 10);
  CHECK(proven < asked / 2);
}
