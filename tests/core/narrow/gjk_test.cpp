// The distance of two cores, in extended precision and in doubles: each way in which the iteration ends, and
// the distance that it found against a closed form.
#include "core/narrow/extended/gjk.h"
#include "core/narrow/filtered/gjk.h"
#include "core/narrow/pair_table.h"
#include "tests/core/narrow/convex_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;
namespace extended = touchstone::narrow::extended;
namespace filtered = touchstone::narrow::filtered;
using narrow::GjkResult;
using narrow::GjkStatus;

namespace {

const Quat tilted{0.3, -0.2, 0.5, 0.8};

struct Known {
  const char* name;
  ConvexPair pair;
  double distance;  // of the cores
};

// Cores whose nearest features are a face, an edge, a corner, a rim and a smooth side.
std::vector<Known> separated_pairs() {
  const Shape cube = Box{{1, 1, 1}}, ball = Sphere{0.5}, rod = Capsule{0.1, 2}, drum = Cylinder{1, 1},
              hat = Cone{1, 1}, egg = Ellipsoid{{1, 2, 3}};
  const double edge = std::hypot(2.0, 2.0);
  return {
      {"faces", pair_at(cube, cube, {5, 0.5, 0}), 3},
      {"face and corner", pair_at(cube, ball, {0.25, 4, 0.5}), 3},
      {"corner and centre", pair_at(cube, ball, {3, 3, 2}), 3},
      {"edges across", pair_at(cube, cube, {4, 4, 0.5}), edge},
      {"crossed segments", pair_at(rod, rod, {0, 3, 0}, {0, 1, 0, 1}), 3},
      {"rim and centre", pair_at(drum, ball, {4, 0, 5}), 5},
      {"apex and centre", pair_at(hat, ball, {0, 0, 3}), 2},
      {"sides of drums", pair_at(drum, drum, {3, 0, 0.5}), 1},
      {"poles of ellipsoids", pair_at(egg, egg, {0, 9, 0}), 5},
      {"equal balls along a diagonal", pair_at(Ellipsoid{{1, 1, 1}}, Ellipsoid{{1, 1, 1}}, {4, 4, 2}), 4}};
}

extended::Distance<Wide> run(const ExtendedPair& p, Wide tolerance, Wide touching, int cap = 2000) {
  return extended::gjk<Wide>(p.a, p.b, tolerance, touching, cap);
}

// What holds however the iteration ended: the points belong to the bounds.
void check_bounds(const extended::Distance<Wide>& g, double distance, double tolerance) {
  CHECK(static_cast<double>(g.lower) <= distance + tolerance);
  CHECK(static_cast<double>(g.upper) >= distance - tolerance);
  CHECK(static_cast<double>((g.b - g.a).norm() - g.upper) == Approx(0).margin(tolerance));
}

constexpr double infinite = std::numeric_limits<double>::infinity();

GjkResult<double> run(const FilteredPair<double>& p, double tolerance, double certain = infinite,
                      const Vec3& guess = Vec3::Zero()) {
  return filtered::gjk<double>(p.difference, tolerance, certain, p.size, guess);
}

}  // namespace

TEST_CASE("gjk: separated cores, with their distance", "[narrow][gjk]") {
  for (const Known& k : separated_pairs()) {
    INFO(k.name);
    const ExtendedPair p(k.pair);
    const auto g = run(p, p.tolerance(), p.touching());
    REQUIRE(g.status == GjkStatus::separated);
    CHECK(static_cast<double>(g.upper) == Approx(k.distance).epsilon(1e-15));
    CHECK(static_cast<double>(g.upper - g.lower) <= 0x1p-52 * static_cast<double>(p.size));
    CHECK(static_cast<double>(g.normal.norm()) == Approx(1).epsilon(1e-15));
    check_bounds(g, k.distance, 1e-15);
  }
}

TEST_CASE("gjk: cores that overlap are enclosed", "[narrow][gjk]") {
  const Shape cube = Box{{1, 1, 1}}, egg = Ellipsoid{{1, 2, 3}};
  for (const ConvexPair& pair : {pair_at(cube, cube, {0.7, 0.4, 0.3}, tilted), pair_at(egg, cube, {1, 1, 1}),
                                 pair_at(egg, egg, {0.5, 0.1, 0}, tilted)}) {
    const ExtendedPair p(pair);
    const auto g = run(p, p.tolerance(), p.touching());
    REQUIRE(g.status == GjkStatus::enclosed);
    REQUIRE(g.simplex.size == 4);
    // The tetrahedron of support points does contain the origin: with it, each corner is on the same side of
    // the plane through the others.
    for (std::size_t i = 0; i < 4; ++i) {
      const WideVec &x = g.simplex.p[(i + 1) % 4].w, &y = g.simplex.p[(i + 2) % 4].w,
                    &z = g.simplex.p[(i + 3) % 4].w;
      const WideVec n = (y - x).cross(z - x);
      CHECK(n.dot(-x) * n.dot(g.simplex.p[i].w - x) > 0);
    }
    CHECK(g.margin > 0);
  }
}

TEST_CASE("gjk: cores that share one point are touching", "[narrow][gjk]") {
  const Shape cube = Box{{1, 1, 1}}, ball = Sphere{0.5}, drum = Cylinder{1, 1};
  for (const ConvexPair& pair :
       {pair_at(ball, ball, {0, 0, 0}), pair_at(cube, ball, {1, 1, 1}), pair_at(cube, ball, {1, 0.25, 0.5}),
        pair_at(cube, cube, {2, 2, 2}), pair_at(drum, ball, {0, 0, 1})}) {
    const ExtendedPair p(pair);
    const auto g = run(p, p.tolerance(), p.touching());
    REQUIRE(g.status == GjkStatus::touching);
    CHECK(g.upper <= p.touching());
    check_bounds(g, 0, 1e-15);
  }
}

TEST_CASE("gjk: a tolerance that rounding cannot meet stalls with valid bounds", "[narrow][gjk]") {
  for (int i = 1; i <= 20; ++i) {
    const Shape egg = Ellipsoid{{1, 2, 3}}, ball = Ellipsoid{{0.5, 0.5, 0.5}};
    // The centre is on the x axis of the ellipsoid, whose curvature there keeps the foot at its pole.
    const ExtendedPair p(pair_at(egg, ball, {2 + i / 7.0, 0, 0}, tilted));
    const auto g = run(p, -1, 0);
    REQUIRE(g.status == GjkStatus::stalled);
    CHECK(static_cast<double>(g.upper) == Approx(0.5 + i / 7.0).epsilon(1e-15));
    CHECK(static_cast<double>(g.lower) == Approx(0.5 + i / 7.0).epsilon(1e-15));
    check_bounds(g, 0.5 + i / 7.0, 1e-15);
  }
}

TEST_CASE("gjk: too few iterations are capped with valid bounds", "[narrow][gjk]") {
  const ExtendedPair p(pair_at(Ellipsoid{{1, 2, 3}}, Ellipsoid{{1, 2, 3}}, {5, 0, 0}));
  // Start off the axis on which the poles lie, so that it has to converge.
  const ExtendedPair q(pair_at(Ellipsoid{{1, 2, 3}}, Ellipsoid{{3, 1, 1}}, {3, 4, 5}, tilted));
  const auto exact = run(q, q.tolerance(), q.touching());
  REQUIRE(exact.status == GjkStatus::separated);
  for (const int cap : {1, 2, 3, 4}) {
    const auto g = run(q, q.tolerance(), q.touching(), cap);
    CHECK(g.status == GjkStatus::capped);
    CHECK(g.iterations == cap + 1);
    check_bounds(g, static_cast<double>(exact.upper), 1e-14);
    CHECK(g.lower < exact.lower);
  }
  CHECK(run(p, p.tolerance(), p.touching(), 8).status == GjkStatus::separated);
}

TEST_CASE("filtered gjk: bounded by its tolerance, with the distance", "[narrow][gjk]") {
  for (const Known& k : separated_pairs()) {
    INFO(k.name);
    const FilteredPair<double> p(k.pair);
    const auto g = run(p, 16 * 0x1p-53 * p.size);
    REQUIRE(g.status == GjkStatus::separated);
    CHECK(g.upper == Approx(k.distance).epsilon(1e-14));
    CHECK(g.lower <= k.distance + 8 * 0x1p-53 * p.size);
    CHECK(g.upper - g.lower <= 16 * 0x1p-53 * p.size);
    // The support plane of the lower bound is one.
    CHECK(g.normal.dot(p.difference.support(-g.normal).w) == Approx(g.lower).epsilon(1e-14));
    // The last direction, as the next query's guess, ends at once.
    const auto again = run(p, 16 * 0x1p-53 * p.size, infinite, g.normal);
    CHECK(again.status == GjkStatus::separated);
    CHECK(again.upper == Approx(k.distance).epsilon(1e-14));
  }
}

TEST_CASE("filtered gjk: a verdict alone ends with the first plane that separates", "[narrow][gjk]") {
  const FilteredPair<double> p(pair_at(Ellipsoid{{1, 2, 3}}, Box{{1, 1, 1}}, {6, 0.5, 0.3}, tilted));
  const auto g = run(p, 0, 1e-12);
  CHECK(g.status == GjkStatus::separated);
  CHECK(g.iterations == 1);
  CHECK(g.lower > 1e-12);
  // The centres are 6.03 apart, the reaches 3 and √3.
  CHECK(g.lower <= 6.03 - 1);
}

TEST_CASE("filtered gjk: enclosed with a margin that is room for the origin", "[narrow][gjk]") {
  const Shape cube = Box{{1, 1, 1}};
  const FilteredPair<double> p(pair_at(cube, cube, {0.7, 0.4, 0.3}, tilted));
  const auto g = run(p, 16 * 0x1p-53 * p.size);
  REQUIRE(g.status == GjkStatus::enclosed);
  REQUIRE(g.simplex.size == 4);
  CHECK(g.margin > 0);
  // A ball of that radius about the origin is in the tetrahedron, hence in B − A: the depth exceeds it.
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0, 0.8), Vec3(-0.6, 0, -0.8)}) {
    double most = -infinite;
    for (const auto& v : g.simplex.p) most = std::max(most, n.dot(v.w));
    CHECK(most >= g.margin);
  }
}

TEST_CASE("filtered gjk: a shared point is touching", "[narrow][gjk]") {
  const Shape cube = Box{{1, 1, 1}}, ball = Sphere{0.5};
  for (const ConvexPair& pair :
       {pair_at(ball, ball, {0, 0, 0}), pair_at(cube, ball, {1, 1, 1}), pair_at(cube, cube, {2, 2, 2})}) {
    const FilteredPair<double> p(pair);
    const auto g = run(p, 16 * 0x1p-53 * p.size);
    CHECK(g.status == GjkStatus::touching);
    CHECK(g.upper <= 4 * 0x1p-53 * p.size);
    CHECK(g.lower <= 0);
  }
}

TEST_CASE("filtered gjk: a tolerance that rounding cannot meet stalls with valid bounds", "[narrow][gjk]") {
  for (int i = 1; i <= 20; ++i) {
    const FilteredPair<double> p(
        pair_at(Cylinder{1, 2}, Ellipsoid{{0.5, 0.5, 0.5}}, {1.5 + i / 7.0, 0, 0.25}, tilted));
    const auto g = run(p, -1);
    REQUIRE(g.status == GjkStatus::stalled);
    CHECK(g.upper == Approx(i / 7.0).epsilon(1e-13));
    CHECK(g.lower == Approx(i / 7.0).epsilon(1e-13));
  }
}

TEST_CASE("filtered verdicts: apart, meeting, touching and unsure", "[narrow][gjk]") {
  using filtered::Asked;
  using filtered::Found;
  CHECK(filtered::decide(1e-9, 1e-10) == Found::apart);
  CHECK(filtered::decide(-1e-9, 1e-10) == Found::meeting);
  CHECK(filtered::decide(1e-11, 1e-10) == Found::touching);
  CHECK(filtered::decide(-1e-11, 1e-10) == Found::touching);

  const Shape egg = Ellipsoid{{1, 2, 3}};
  const auto ask = [&](double x, Asked asked) {
    narrow::FastAnswer<double> f;
    narrow::separate_fast<double>({&egg, {}}, {&egg, {Vec3(x, 0, 0), {}}}, asked, f);
    return f.answer;
  };
  CHECK(ask(2.5, Asked::overlap).found == Found::apart);
  CHECK(ask(1.5, Asked::overlap).found == Found::meeting);
  CHECK(ask(2, Asked::overlap).found == Found::touching);
  for (const double x : {2.5, 1.5, 2.0}) {
    const auto d = ask(x, Asked::distance);
    CHECK(d.found == (x > 2 ? Found::apart : x < 2 ? Found::meeting : Found::touching));
    CHECK(std::abs(d.gap - (x - 2)) <= d.bound);
    CHECK(d.bound <= 1e-13);
    CHECK(std::abs(d.normal.x()) == Approx(1).epsilon(1e-12));
  }
  // Bodies of 1e-200 at 1e+160: no scale fits both numbers.
  const Shape speck = Ellipsoid{{1e-200, 2e-200, 3e-200}};
  const Pose far{Vec3(1e160, 0, 0), {}};
  for (const Asked asked : {Asked::overlap, Asked::distance, Asked::contact}) {
    narrow::FastAnswer<double> f;
    narrow::separate_fast<double>({&speck, far}, {&speck, far}, asked, f);
    CHECK(f.answer.found == Found::unsure);
    CHECK(f.answer.bound == infinite);
  }
}
