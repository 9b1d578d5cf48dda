// Contacts of faces and edges that are parallel up to a small angle, against the referee's contact region.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/math/rng.h"
#include "core/narrow/narrow_phase.h"
#include "oracles/referee/region/contact_region.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

Quat turn_about(const Vec3& axis, double angle) {
  const Vec3 v = axis.normalized() * std::sin(angle / 2);
  return {v.x(), v.y(), v.z(), std::cos(angle / 2)};
}

struct Pair {
  Shape a, b;
  Pose pose_a, pose_b;
  PlacedShape placed_a() const { return {&a, pose_a}; }
  PlacedShape placed_b() const { return {&b, pose_b}; }
};

// What share of the region of features within 1e-6 of their support planes the manifold covers.
double covered(const Pair& p, const ContactAnswer& r) {
  constexpr double slack = 1e-6;
  const referee::ContactRegion region =
      referee::contact_region({&p.a, p.pose_a}, {&p.b, p.pose_b}, r.normal, slack);
  std::vector<Vec3> points;
  for (const ContactPoint& x : r.manifold) points.push_back(x.position);
  return referee::covered_share(region, points, r.normal).value_or(-1);
}

// Each point is within half its depth of both bodies, and no deeper than the contact.
void check_points(const Pair& p, const ContactAnswer& r) {
  constexpr double rounding = 4e-14;  // less than τ, 5e-14
  double most = 0;
  for (const ContactPoint& x : r.manifold) {
    CHECK(x.depth <= r.depth + rounding);
    most = std::max(most, x.depth);
    CHECK(referee::distance_to({&p.a, p.pose_a}, x.position).lo <= x.depth / 2 + rounding);
    CHECK(referee::distance_to({&p.b, p.pose_b}, x.position).lo <= x.depth / 2 + rounding);
    // The ends of the line through the point are on both bodies.
    CHECK(referee::distance_to({&p.a, p.pose_a}, x.position + r.normal * (x.depth / 2)).lo <= rounding);
    CHECK(referee::distance_to({&p.b, p.pose_b}, x.position - r.normal * (x.depth / 2)).lo <= rounding);
  }
  CHECK(most >= r.depth * (1 - 1e-6));
}

}  // namespace

TEST_CASE("deep points stay when a corner beyond the border of a face passes its plane",
          "[narrow][manifold]") {
  // A tilted box hangs over an edge of a table and rises from it: one corner after the other leaves the plane
  // of the table top, those beside the table last or first.
  constexpr double step = 1e-3, deep = 0.02, near = 0.02;
  const Vec3 half(0.5, 0.4, 0.2);
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  const Shape shape = GENERATE_COPY(Shape(Box{half}), Shape(make_hull(corners)));
  const auto manifold = [&](double tilt, double turn, double height) {
    const Pair p{
        Box{{1, 1, 0.5}},
        shape,
        {},
        {{0.8, 0.3, 0.5 + height}, turn_about(Vec3(0, 0, 1), turn) * turn_about(Vec3(0, 1, 0), tilt)}};
    const ContactAnswer r = contact(p.placed_a(), p.placed_b());
    if (r.overlap && r.normal.z() == 1) check_points(p, r);
    return r;
  };
  int compared = 0;
  for (const double tilt : {-0.3, -0.1, 0.1, 0.3})
    for (const double turn : {0.0, 0.4, 1.2}) {
      std::optional<ContactAnswer> was;
      for (double height = 0.1; height < 0.24; height += step) {
        const ContactAnswer is = manifold(tilt, turn, height);
        if (!is.overlap) break;
        if (was && was->normal.z() == 1 && is.normal.z() == 1)
          for (const auto& [from, to] :
               {std::pair(&std::as_const(*was), &is), std::pair(&is, &std::as_const(*was))})
            for (const ContactPoint& x : from->manifold) {
              if (x.depth < deep) continue;
              INFO("tilt " << tilt << ", turn " << turn << ", height " << height << ", depth " << x.depth);
              ++compared;
              CHECK(std::ranges::any_of(to->manifold, [&](const ContactPoint& y) {
                return (x.position - y.position).norm() < near;
              }));
            }
        was = is;
      }
    }
  CHECK(compared > 1000);
}

TEST_CASE("nearly parallel faces and edges have a whole contact", "[narrow][manifold]") {
  Rng rng(31);
  int by_edges = 0;
  for (double angle = 1e-13; angle < 2e-7; angle *= 10)
    for (int i = 0; i < 40; ++i) {
      INFO("angle " << angle << ", " << i);
      Pair p{Box{{2, 1.5, 1}}, Box{{1, 0.75, 0.5}}, {}, {}};
      const Vec3 axis(rng.uniform(-1, 1), rng.uniform(-1, 1), 0);
      p.pose_b.rotation = turn_about(axis, angle) * turn_about(Vec3(0, 0, 1), rng.uniform(0, 3));
      p.pose_b.translation = {rng.uniform(-2, 2), rng.uniform(-1.5, 1.5), 1.49};
      const ContactAnswer r = contact(p.placed_a(), p.placed_b());
      REQUIRE(r.overlap);
      CHECK(r.manifold.size() >= 3);
      CHECK(covered(p, r) >= 0.95);
      check_points(p, r);
      by_edges += r.normal.z() != 1;
    }
  CHECK(by_edges > 10);
}

TEST_CASE("a contact of nearly parallel features has no point twice", "[narrow][manifold]") {
  Rng rng(33);
  constexpr double near = 1e-5;
  int compared = 0;
  for (const double angle : {1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4})
    for (int i = 0; i < 60; ++i) {
      INFO("angle " << angle << ", " << i);
      Pair p{Box{{1, 0.75, 0.5}}, i % 2 ? Shape(Box{{1, 0.75, 0.5}}) : Shape(Cylinder{0.75, 0.5}), {}, {}};
      p.pose_b.rotation = turn_about(Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), 0), angle);
      p.pose_b.translation = {rng.uniform(-1, 1), rng.uniform(-1, 1), 0.99};
      const ContactAnswer r = contact(p.placed_a(), p.placed_b());
      REQUIRE(r.overlap);
      for (const ContactPoint& x : r.manifold)
        for (const ContactPoint& y : r.manifold)
          if (&x != &y) {
            ++compared;
            CHECK((x.position - y.position).norm() > near);
          }
    }
  CHECK(compared > 1000);
}

TEST_CASE("a flat hull whose corners lie on the border of a face has a whole contact", "[narrow][manifold]") {
  // From a campaign: the face's corner at (-0.875, -0.375, -1.125) lies between two of them.
  const Pair p{Box{{1.125, 0.375, 1}},
               make_hull({{-0.25, 0, -0.5}, {0.625, 0, -0.25}, {0.125, 0, 0.25}, {0.5, 0, 0.375}}),
               {{0, 0, 0}, normalized(Quat{0, 1, 0, 1})},
               {{-0.75, -0.5, -0.875}, normalized(Quat{0, 0, 1, 1})}};
  const ContactAnswer r = contact(p.placed_a(), p.placed_b());
  REQUIRE(r.overlap);
  check_points(p, r);
  CHECK(covered(p, r) == Approx(1).epsilon(1e-12));
}

TEST_CASE("a needle's tip keeps its place in a contact", "[narrow][manifold]") {
  Rng rng(34);
  for (int i = 0; i < 400; ++i) {
    // The needle lies in the box, nearly level, its tip inside the face.
    const double radius = std::pow(10, rng.uniform(-8, -3));
    const Pair p{RoundedBox{{1, 0.75, 0.8}, 0.25},
                 Cone{radius, 0.8},
                 {},
                 {{rng.uniform(-0.5, 0.5), 0.9, rng.uniform(-0.9, -0.3)},
                  turn_about(Vec3(1, 0, 0), rng.uniform(-0.4, 0.4) * radius)}};
    const ContactAnswer r = contact(p.placed_a(), p.placed_b());
    REQUIRE(r.overlap);
    check_points(p, r);
  }
}

TEST_CASE("the deepest point is one of the contact's points where corners lie around it",
          "[narrow][manifold]") {
  // An octahedron and a cone on their tips, deep in the ground, in a large box and in one that ends beside
  // them.
  std::vector<Vec3> v;
  for (int k = 0; k < 3; ++k)
    for (const double s : {-1, 1}) v.push_back(s * Vec3::Unit(k));
  const Quat tilt = turn_about(Vec3(1, 2, 0), 0.1), down = turn_about(Vec3(1, 0, 0), std::numbers::pi);
  for (const Shape& ground : {Shape(HalfSpace{{0, 0, 1}, 0}), Shape(Box{{9, 9, 2}}), Shape(Box{{0.5, 2, 2}})})
    for (const auto& [shape, turn] :
         {std::pair(Shape(make_hull(v)), tilt), std::pair(Shape(Cone{1, 1}), tilt * down)})
      for (const double sunk : {0.1, 0.5, 1.1}) {
        const double top = kind_of(ground) == ShapeKind::box ? 2 : 0;
        const Pair p{ground, shape, {}, {{0.1, 0.05, top + 1 - sunk}, turn}};
        const ContactAnswer r = contact(p.placed_a(), p.placed_b());
        REQUIRE(r.overlap);
        check_points(p, r);
        if (r.normal.z() != 1) continue;
        CHECK(std::ranges::any_of(
            r.manifold, [&](const ContactPoint& x) { return x.depth >= r.depth - 1e-12 && x.feature != 0; }));
      }
}

TEST_CASE("the points of a leaning disc are as many in every direction, the deepest among them",
          "[narrow][manifold]") {
  const Shape ground = HalfSpace{{0, 0, 1}, 0}, disc = Cylinder{1, 0.25};
  for (double turn = 0; turn < 6.3; turn += 0.05) {
    const Vec3 axis(std::cos(turn), std::sin(turn), 0);
    const Pair p{ground, disc, {}, {{0, 0, 0.2}, turn_about(axis, 0.01)}};
    const ContactAnswer r = contact(p.placed_a(), p.placed_b());
    REQUIRE(r.overlap);
    CHECK(r.manifold.size() == convex::rim_corners);
    check_points(p, r);
    CHECK(std::ranges::count_if(
              r.manifold, [&](const ContactPoint& x) { return std::abs(x.depth - r.depth) < 1e-14; }) == 1);
  }
}

TEST_CASE("nearly parallel capsules touch along a line", "[narrow][manifold]") {
  Rng rng(32);
  for (double angle = 1e-13; angle < 2e-7; angle *= 10)
    for (int i = 0; i < 40; ++i) {
      INFO("angle " << angle << ", " << i);
      Pair p{Capsule{0.5, 1}, Capsule{0.25 + 0.25 * (i % 2), 1.5}, {}, {}};
      p.pose_b.rotation = turn_about(rng.unit_vector(), angle);
      p.pose_b.translation = {0.7, 0, rng.uniform(-1.5, 1.5)};
      const ContactAnswer r = contact(p.placed_a(), p.placed_b());
      REQUIRE(r.overlap);
      CHECK(r.manifold.size() >= 2);
      CHECK(covered(p, r) >= 0.95);
      check_points(p, r);
    }
}

TEST_CASE("manifolds of most bodies on a lattice cover the contact region", "[narrow][manifold][random]") {
  int regions = 0, covered_well = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Case c = fuzz::make_case(5, i, "lattice");
    if (c.scene.bodies.size() != 2) continue;
    const Body &x = c.scene.bodies[0], &y = c.scene.bodies[1];
    Pair p{c.scene.shape_of(0), c.scene.shape_of(1), x.pose, y.pose};
    const ContactAnswer r = contact(p.placed_a(), p.placed_b());
    if (r.outcome != Outcome::answered || !r.overlap) continue;
    const double share = covered(p, r);
    if (share < 0) continue;
    ++regions;
    covered_well += share >= 0.95;
  }
  CHECK(regions > 80);
  // The others are curved sides and faces whose normal a search has found, to less than rounding.
  CHECK(covered_well >= 0.94 * regions);
}

TEST_CASE("a cut rim covers its contact", "[core][manifold]") {
  Rng rng(20261128);
  int regions = 0, small = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto size = [&] { return rng.uniform(0.25, 1); };
    // With their height above the origin.
    const auto round = [&]() -> std::pair<Shape, double> {
      const double radius = size(), half = size();
      if (rng.chance(0.5)) return {Cylinder{radius, half}, half};
      return {Padded<Cylinder>{{radius, half}, 0.125}, half + 0.125};
    };
    const auto flat = [&]() -> std::pair<Shape, double> {
      if (rng.chance(0.3)) return round();
      const double x = size(), y = size();
      return {Box{{x, y, 0.5}}, 0.5};
    };
    const auto [a, top] = round();
    const auto [b, bottom] = flat();
    Pair p{a, b, {}, {}};
    const double overlap = rng.chance(0.5) ? 0 : rng.uniform(1e-3, 0.05);
    const double turn = rng.uniform(0, 3), x = rng.uniform(-1.5, 1.5), y = rng.uniform(-1.5, 1.5);
    p.pose_b = {{x, y, top + bottom - overlap}, turn_about(Vec3(0, 0, 1), turn)};
    if (rng.chance(0.5)) std::swap(p.a, p.b), std::swap(p.pose_a, p.pose_b);
    const ContactAnswer r = contact(p.placed_a(), p.placed_b());
    REQUIRE(r.outcome == Outcome::answered);
    if (!r.overlap || std::abs(r.normal.z()) < 0.999999) continue;
    const double share = covered(p, r);
    if (share < 0) continue;
    INFO(i << ", overlap " << overlap);
    CHECK(share >= 0.95);
    check_points(p, r);
    ++regions;
    small += r.manifold.size() < 12;
  }
  CHECK(regions > 1000);
  CHECK(small > 100);
}

TEST_CASE("a straight line on a cylinder meets an edge along its length", "[core][manifold]") {
  Rng rng(7);
  for (int i = 0; i < 1000; ++i) {
    const double radius = rng.uniform(0.25, 1), other = rng.uniform(0.25, 1);
    const bool box = rng.chance(0.5);
    Pair p{
        Cylinder{radius, 0.75}, box ? Shape(Box{{other, other, 0.5}}) : Shape(Cylinder{other, 0.5}), {}, {}};
    const double angle = rng.uniform(0, 6), depth = rng.uniform(0.01, 0.1);
    const Vec3 n(std::cos(angle), std::sin(angle), 0);
    const double reach = radius + (box ? std::sqrt(2.0) * other : other) - depth;
    const Quat turned = turn_about(Vec3(0, 0, 1), angle + std::numbers::pi / 4);
    p.pose_b = {n * reach + Vec3(0, 0, rng.uniform(-0.5, 0.5)), turned};
    if (rng.chance(0.5)) std::swap(p.a, p.b), std::swap(p.pose_a, p.pose_b);
    const ContactAnswer r = contact(p.placed_a(), p.placed_b());
    REQUIRE(r.outcome == Outcome::answered);
    INFO(i << " " << box);
    CHECK(covered(p, r) >= 0.95);
    check_points(p, r);
  }
}
