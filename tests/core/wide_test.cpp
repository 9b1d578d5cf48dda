// Extended precision, whichever implementation is built in: no answer depends on the unit of length.
#include <cmath>
#include <limits>

#include "core/broad/body_box.h"
#include "core/impact/impact.h"
#include "core/narrow/wide_answer.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

// Powers of two at which lengths of about 1 remain doubles, but their squares may not.
constexpr int units[] = {-960, -540, -300, -70, 70, 300, 540, 1000};

Shape in_unit(Shape s, int e) {
  scale_shape(s, std::ldexp(1.0, e));
  return s;
}

Pair in_unit(const Pair& p, int e) {
  Pair q{in_unit(p.a, e), in_unit(p.b, e), p.pose_a, p.pose_b};
  q.pose_a.translation *= std::ldexp(1.0, e);
  q.pose_b.translation *= std::ldexp(1.0, e);
  return q;
}

Pair plain_pair(Rng& r) {
  const auto kind = [&] { return static_cast<ShapeKind>(r.below(7)); };
  Pair p{random_shape(r, kind(), false),
         random_shape(r, r.chance(0.1) ? ShapeKind::half_space : kind(), false),
         {},
         {}};
  p.pose_a = {r.unit_vector(), r.rotation()};
  p.pose_b = {r.unit_vector() * r.uniform(0.5, 3), r.rotation()};
  return p;
}

double size_of(const Pair& p) { return std::max(1.0, scale_of(p)); }

}  // namespace

TEST_CASE("signed distances in extended precision scale with the unit of length", "[wide]") {
  Rng r(11);
  int answered = 0;
  for (int i = 0; i < 60; ++i) {
    const Pair p = plain_pair(r);
    const Separation s = separation(p.placed_a(), p.placed_b());
    if (s.outcome != Outcome::answered) continue;
    ++answered;
    const int e = units[i % std::size(units)];
    const Pair q = in_unit(p, e);
    const Separation t = separation(q.placed_a(), q.placed_b());
    INFO("pair " << i << ", unit 2^" << e);
    REQUIRE(t.outcome == Outcome::answered);
    const double tolerance = 0x1p-49 * size_of(p);
    CHECK(std::abs(static_cast<double>(ldexp(t.gap, -e) - s.gap)) <= tolerance);
    CHECK(std::abs(static_cast<double>(ldexp(wide_norm(t.b - t.a), -e) - abs(s.gap))) <= tolerance);
    const ContactAnswer c = narrow::wide_contact(p.placed_a(), p.placed_b());
    const ContactAnswer d = narrow::wide_contact(q.placed_a(), q.placed_b());
    CHECK(c.overlap == d.overlap);
    CHECK(c.manifold.size() == d.manifold.size());
  }
  CHECK(answered > 40);
}

TEST_CASE("signed distances do not depend on the unit of length", "[wide]") {
  Rng r(13);
  int answered = 0;
  for (int i = 0; i < 600; ++i) {
    const Pair p = plain_pair(r);
    const DistanceAnswer x = distance(p.placed_a(), p.placed_b());
    if (x.outcome != Outcome::answered) continue;
    const int e = units[i % std::size(units)];
    const Pair q = in_unit(p, e);
    const DistanceAnswer y = distance(q.placed_a(), q.placed_b());
    INFO("pair " << i << " of kinds " << p.a.index() << " and " << p.b.index() << ", unit 2^" << e);
    REQUIRE(y.outcome == Outcome::answered);
    ++answered;
    CHECK(std::abs(x.distance - std::ldexp(y.distance, -e)) <= 0x1p-46 * size_of(p));
    CHECK(overlap(q.placed_a(), q.placed_b()).overlap == (y.distance <= 0));
  }
  CHECK(answered > 500);
}

TEST_CASE("times of impact do not depend on the unit of length", "[wide]") {
  Rng r(12);
  int hits = 0;
  for (int i = 0; i < 40; ++i) {
    const Pair p = plain_pair(r);
    const Motion turn{{0, 0, 0}, r.vector(0.1, 2)};
    const Motion way{(p.pose_a.translation - p.pose_b.translation) * 1.2, {0, 0, 0}};
    if (kind_of(p.b) == ShapeKind::half_space) continue;
    const auto impact = [&](const Pair& x, int e) {
      return time_of_impact({&x.a, x.pose_a, turn},
                            {&x.b, x.pose_b, {way.linear * std::ldexp(1.0, e), {0, 0, 0}}});
    };
    const int e = units[i % std::size(units)];
    const ImpactAnswer x = impact(p, 0), y = impact(in_unit(p, e), e);
    INFO("pair " << i << ", unit 2^" << e);
    CHECK(x.outcome == y.outcome);
    REQUIRE(x.toi.has_value() == y.toi.has_value());
    if (!x.toi) continue;
    ++hits;
    CHECK(std::abs(*x.toi - *y.toi) <= 1e-12);
    CHECK(std::abs(x.separation - std::ldexp(y.separation, -e)) <= 0x1p-46 * size_of(p));
  }
  CHECK(hits > 20);
}

TEST_CASE("quaternions, normals and velocities of any length are understood", "[wide]") {
  const Shape box = Box{{1, 2, 3}};
  for (const double k : {0x1p-1060, 0x1p-600, 1.0, 0x1p600, 0x1p1020}) {
    const Pose turned{{0, 0, 5}, {k, 0, 0, k}};  // z to −y, y to z
    const Shape plane = HalfSpace{{0, 0, k}, 0};
    const Separation s = separation({&box, turned}, {&plane, {}});
    REQUIRE(s.outcome == Outcome::answered);
    CHECK(std::abs(static_cast<double>(s.gap - 3)) <= 1e-15);
    const Aabb bounds = broad::body_box(box, turned);
    CHECK(bounds.lo.isApprox(Vec3(-1, -3, 3), 1e-14));
    CHECK(bounds.hi.isApprox(Vec3(1, 3, 7), 1e-14));
  }
  for (const double k : {0x1p-1060, 0x1p-600, 0x1p-100})
    CHECK(wide_norm(Vec3(3 * k, 0, 4 * k).cast<Wide>()) == 5 * Wide(k));
}

TEST_CASE("boxes contain ellipsoids and balls at every scale", "[wide]") {
  Rng r(13);
  for (const int e : {-1060, -960, -540, 0, 540, 1000}) {
    const double k = std::ldexp(1.0, e);
    for (int i = 0; i < 20; ++i) {
      const Vec3 axes(r.uniform(0.2, 1.5), r.uniform(0.2, 1.5), r.uniform(0.2, 1.5));
      const Pose at{{0, 0, 0}, r.rotation()};
      const WideMat rotation = wide_rotation(at.rotation);
      const Vec3 scaled = axes * k;
      const Aabb box = broad::body_box(Ellipsoid{scaled}, at);
      for (int axis = 0; axis < 3; ++axis) {
        // In units of k, where squares are harmless; subnormal semi-axes are compared as rounded.
        const Vec3 rounded(std::ldexp(scaled.x(), -e), std::ldexp(scaled.y(), -e),
                           std::ldexp(scaled.z(), -e));
        const Wide half = WideVec(rotation.row(axis).transpose().cwiseProduct(rounded.cast<Wide>())).norm();
        CHECK(ldexp(Wide(box.hi[axis]), -e) >= half);
        CHECK(-ldexp(Wide(box.lo[axis]), -e) >= half);
        const double slack = e > -1000 ? 1e-15 : 1e-3;  // 16 units of the least double at 2^-1060
        CHECK(static_cast<double>(ldexp(Wide(box.hi[axis]), -e) - half) <= slack * 2);
      }
    }
  }
}
