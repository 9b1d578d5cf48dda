// The depth of two cores that overlap, in extended precision and in doubles: each way in which the polytope
// ends, and the depth that it found against a closed form.
#include <memory>

#include "core/narrow/extended/epa.h"
#include "core/narrow/filtered/epa.h"
#include "tests/core/narrow/convex_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;
namespace extended = touchstone::narrow::extended;
namespace filtered = touchstone::narrow::filtered;
using extended::EpaResult;
using extended::EpaStatus;
using filtered::ExpandEnd;
using narrow::GjkStatus;

namespace {

struct Known {
  const char* name;
  ConvexPair pair;
  double depth;
  Vec3 normal;  // A to B
};

std::vector<Known> overlapping_pairs() {
  const Shape cube = Box{{1, 1, 1}}, ball = Sphere{0.5}, egg = Ellipsoid{{1, 2, 3}}, drum = Cylinder{1, 1},
              slab = Box{{3, 3, 1}};
  return {{"boxes", pair_at(cube, cube, {1.5, 0.25, 0.125}), 0.5, Vec3::UnitX()},
          {"a box turned about the normal", pair_at(cube, cube, {0.1, 0.2, 1.75}, {0, 0, 0.3, 1}), 0.25,
           Vec3::UnitZ()},
          {"a centre in a box", pair_at(cube, ball, {0.25, 0.5, -0.625}), 0.375, -Vec3::UnitZ()},
          {"ellipsoids along the shortest axis", pair_at(egg, egg, {1.5, 0, 0}), 0.5, Vec3::UnitX()},
          {"balls along a diagonal", pair_at(Ellipsoid{{2, 2, 2}}, Ellipsoid{{1, 1, 1}}, {1, 0.5, 1}), 1.5,
           Vec3(1, 0.5, 1) / 1.5},
          {"a drum on a slab", pair_at(slab, drum, {0.5, 0.25, 1.75}), 0.25, Vec3::UnitZ()},
          {"a drum beside a slab", pair_at(slab, drum, {3.75, 0.25, 0}), 0.25, Vec3::UnitX()}};
}

constexpr int budget = 400;

EpaResult<Wide> run(const ExtendedPair& p, Wide tolerance, int expansions = budget) {
  const auto g = extended::gjk<Wide>(p.a, p.b, p.tolerance(), p.touching(), 2000);
  REQUIRE((g.status == GjkStatus::enclosed || g.status == GjkStatus::touching));
  return extended::Epa<Wide>(p.a, p.b, p.size, tolerance).run(g, expansions);
}

filtered::Depth<double> run(const FilteredPair<double>& p, double tolerance) {
  const auto g = filtered::gjk<double>(p.difference, 16 * 0x1p-53 * p.size,
                                       std::numeric_limits<double>::infinity(), p.size, Vec3::Zero());
  REQUIRE((g.status == GjkStatus::enclosed || g.status == GjkStatus::touching));
  const auto polytope = std::make_unique<filtered::Expander<double>>(p.difference, p.size, tolerance);
  return polytope->run(g.simplex, g.status == GjkStatus::enclosed);
}

double tolerance_of(const FilteredPair<double>& p) { return 16 * 0x1p-53 * p.size; }

}  // namespace

TEST_CASE("epa: closed, with the least depth, its direction and points that far apart", "[narrow][epa]") {
  for (const Known& k : overlapping_pairs()) {
    INFO(k.name);
    const ExtendedPair p(k.pair);
    const auto e = run(p, p.tolerance());
    REQUIRE(e.status == EpaStatus::closed);
    CHECK(static_cast<double>(e.upper) == Approx(k.depth).epsilon(1e-14));
    CHECK(static_cast<double>(e.lower) == Approx(k.depth).epsilon(1e-14));
    CHECK((e.normal.cast<double>() - k.normal).norm() <= 1e-6);
    CHECK((e.a - e.b - e.normal * e.upper).cast<double>().norm() <= 1e-6);
  }
}

TEST_CASE("epa: a difference without interior is flat, of depth 0", "[narrow][epa]") {
  const Shape rod = Capsule{0.1, 2}, ball = Sphere{0.5};
  Hull triangle;
  triangle.vertices = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  for (const auto& [name, pair] :
       {std::pair{"a point", pair_at(ball, ball, {0, 0, 0})},
        std::pair{"collinear segments", pair_at(rod, rod, {0, 0, 1})},
        std::pair{"a point on a segment", pair_at(rod, ball, {0, 0, 1})},
        std::pair{"crossed segments", pair_at(rod, rod, {0.5, 0, 0.25}, {0, 1, 0, 1})},
        std::pair{"coplanar triangles", pair_at(triangle, triangle, {0.25, 0.5, 0})}}) {
    INFO(name);
    const ExtendedPair p(pair);
    const auto e = run(p, p.tolerance());
    CHECK(e.status == EpaStatus::flat);
    CHECK(std::abs(static_cast<double>(e.upper)) <= 1e-17);
    CHECK(static_cast<double>(e.normal.norm()) == Approx(1));

    const FilteredPair<double> q(pair);
    const auto d = run(q, tolerance_of(q));
    CHECK(d.end == ExpandEnd::flat);
    CHECK(std::abs(d.upper) <= 64 * 0x1p-53 * q.size);
  }
}

TEST_CASE("epa: an exhausted budget is explored, with bounds around the depth", "[narrow][epa]") {
  // Every direction is a minimum: no polytope closes.
  const ExtendedPair p(pair_at(Ellipsoid{{1, 1, 1}}, Ellipsoid{{2, 2, 2}}, {0, 0, 0}));
  double last = 0;
  for (const int expansions : {20, 80, 320}) {
    const auto e = run(p, p.tolerance(), expansions);
    REQUIRE(e.status == EpaStatus::explored);
    CHECK(static_cast<double>(e.upper) == Approx(3).epsilon(1e-15));
    CHECK(e.lower < 3);
    CHECK(static_cast<double>(e.lower) > last);
    last = static_cast<double>(e.lower);
    CHECK(e.iterations >= expansions);
  }
  CHECK(last > 2.9);
}

TEST_CASE("epa: a tolerance that rounding cannot meet is broken, with valid bounds", "[narrow][epa]") {
  for (const Known& k : overlapping_pairs()) {
    INFO(k.name);
    const ExtendedPair p(k.pair);
    // The nearest facet cannot be moved outward any more.
    const auto e = run(p, Wide(-0x1p-90));
    CHECK(e.status == EpaStatus::broken);
    CHECK(static_cast<double>(e.upper) == Approx(k.depth).epsilon(1e-14));
    CHECK(static_cast<double>(e.lower) == Approx(k.depth).epsilon(1e-14));
    // Every new facet counts as folded inward: the horizon cannot be repaired.
    const auto early = run(p, -1);
    CHECK(early.status == EpaStatus::broken);
    CHECK(static_cast<double>(early.upper) >= k.depth * (1 - 1e-15));
    CHECK(static_cast<double>(early.lower) <= k.depth * (1 + 1e-15));
  }
}

TEST_CASE("filtered epa: closed, with the least depth, its direction and its foot", "[narrow][epa]") {
  for (const Known& k : overlapping_pairs()) {
    INFO(k.name);
    const FilteredPair<double> p(k.pair);
    const auto e = run(p, tolerance_of(p));
    REQUIRE(e.end == ExpandEnd::closed);
    CHECK(e.upper == Approx(k.depth).epsilon(1e-13));
    CHECK(e.lower == Approx(k.depth).epsilon(1e-13));
    CHECK(e.lower <= k.depth + 4 * 0x1p-53 * p.size);
    CHECK((e.outward + k.normal).norm() <= 1e-6);
    CHECK(e.w.norm() == Approx(k.depth).epsilon(1e-12));
  }
}

TEST_CASE("filtered epa: storage exhausted is full, with bounds around the depth", "[narrow][epa]") {
  const FilteredPair<double> p(pair_at(Ellipsoid{{1, 1, 1}}, Ellipsoid{{2, 2, 2}}, {0, 0, 0}));
  // Every direction is a minimum (the product answers this pair in closed form, revolved.h).
  const auto e = run(p, tolerance_of(p));
  REQUIRE(e.end == ExpandEnd::full);
  CHECK(e.vertices == filtered::Expander<double>::vertex_capacity);
  CHECK(e.upper == Approx(3).epsilon(1e-14));
  CHECK(e.lower < 3);
  CHECK(e.lower > 2.8);
}

TEST_CASE("filtered epa: bounds within three tolerances are full after enough vertices", "[narrow][epa]") {
  const FilteredPair<double> p(pair_at(Ellipsoid{{1, 1, 1}}, Ellipsoid{{2, 2, 2}}, {0, 0, 0}));
  const auto all = run(p, tolerance_of(p));
  // Twice the gap that 160 vertices leave: 65 of them leave at most three times that, but not once.
  const double tolerance = 2 * (all.upper - all.lower);
  const auto e = run(p, tolerance);
  REQUIRE(e.end == ExpandEnd::full);
  CHECK(e.vertices > filtered::Expander<double>::patience);
  CHECK(e.vertices < filtered::Expander<double>::vertex_capacity);
  CHECK(e.upper == Approx(3).epsilon(1e-14));
  CHECK(e.lower < 3);
  CHECK(e.upper - e.lower > tolerance);
  CHECK(e.upper - e.lower <= 3 * tolerance);
}

TEST_CASE("filtered epa: broken by a tolerance below rounding, or by a start that is a sliver",
          "[narrow][epa]") {
  const Shape cube = Box{{1, 1, 1}};
  const FilteredPair<double> p(pair_at(cube, cube, {1.5, 0.25, 0.125}));
  const auto e = run(p, -1);
  CHECK(e.end == ExpandEnd::broken);
  CHECK(e.upper == 0.5);
  CHECK(e.lower == 0.5);

  // Two corners 1e-15 apart: a tetrahedron whose facets have no normals.
  narrow::Simplex<double> start;
  start.size = 4;
  const Vec3 corners[4] = {
      {3.5, 2, 2}, {-0.5, -1.75, -1.875}, {-0.5, -1.75 + 1e-15, -1.875}, {-0.5, 2.25, 2.125}};
  for (std::size_t i = 0; i < 4; ++i) start.p[i].w = corners[i];
  const auto polytope = std::make_unique<filtered::Expander<double>>(p.difference, p.size, tolerance_of(p));
  const auto d = polytope->run(start, true);
  CHECK(d.end == ExpandEnd::broken);
  CHECK(d.upper == std::numeric_limits<double>::infinity());
}

TEST_CASE("epa: starts from a touching point, edge or triangle", "[narrow][epa]") {
  const Shape cube = Box{{1, 1, 1}};
  // Cubes that share a corner, part of an edge, and part of a face.
  for (const Vec3& at : {Vec3(2, 2, 2), Vec3(2, 2, 0.5), Vec3(2, 0.25, 0.5)}) {
    const ExtendedPair p(pair_at(cube, cube, at));
    const auto e = run(p, p.tolerance());
    CHECK(e.status == EpaStatus::closed);
    CHECK(std::abs(static_cast<double>(e.upper)) <= 1e-18);
    const FilteredPair<double> q(pair_at(cube, cube, at));
    const auto d = run(q, tolerance_of(q));
    CHECK(d.end == ExpandEnd::closed);
    CHECK(std::abs(d.upper) <= 1e-15);
    CHECK(std::abs(d.lower) <= 1e-15);
  }
}
