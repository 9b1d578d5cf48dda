// Convex pieces in place of a mesh: exact verdicts, and measurements against values known in closed form.
#include "fuzz/cover/cover.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/base/input_error.h"
#include "core/math/rng.h"
#include "fuzz/cover/exact_hull.h"
#include "tests/support/catch.h"

using namespace touchstone;
using fuzz::Cover;
using fuzz::exact_hull;
using fuzz::ExactHull;

namespace {

using Points = std::vector<Vec3>;

Points corners(const Vec3& lo, const Vec3& hi) {
  Points p;
  for (int i = 0; i < 8; ++i)
    p.emplace_back((i & 1) != 0 ? hi.x() : lo.x(), (i & 2) != 0 ? hi.y() : lo.y(),
                   (i & 4) != 0 ? hi.z() : lo.z());
  return p;
}

// The surface of the hull of the points, facing outward.
TriangleMesh surface(const Points& p) {
  const auto h = exact_hull(p);
  REQUIRE(h);
  return {h->points, h->facets};
}

// A prism over a simple polygon in the plane of x and z, from y = -1 to 1, facing outward.
TriangleMesh prism(const std::vector<std::array<double, 2>>& outline,
                   const std::vector<std::array<int, 3>>& front) {
  TriangleMesh m;
  const int n = static_cast<int>(outline.size());
  for (const double y : {-1.0, 1.0})
    for (const auto& [x, z] : outline) m.vertices.emplace_back(x, y, z);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    m.triangles.push_back({i, n + j, j});
    m.triangles.push_back({i, n + i, n + j});
  }
  for (const auto& [a, b, c] : front) {
    m.triangles.push_back({a, b, c});
    m.triangles.push_back({n + a, n + c, n + b});
  }
  return m;
}

Cover covered(const TriangleMesh& mesh, const std::vector<Points>& pieces) {
  const std::atomic<bool> stop{false};
  const std::vector<std::string> names(pieces.size(), "piece");
  return fuzz::cover(
      mesh, pieces, names, [](std::string_view, std::size_t, std::size_t) {}, stop);
}

void check_reach(const fuzz::Reach& r, double truth) {
  INFO(r.bracket.lo << " " << truth << " " << r.bracket.hi);
  CHECK(r.bracket.lo <= truth);
  CHECK(r.bracket.hi >= truth);
  CHECK(r.bracket.hi - r.bracket.lo <= 1.001 * fuzz::bracket_share * r.bracket.hi);
}

double after(double x) { return std::nextafter(x, 10.0); }

}  // namespace

TEST_CASE("the hull of points has every point on or behind every facet, and is closed", "[cover]") {
  Points p = corners({0, 0, 0}, {1, 1, 1});
  // In faces, on edges, inside, and twice.
  for (const Vec3& more : {Vec3(0.5, 0.5, 1), Vec3(0.25, 0, 0), Vec3(0.3, 0.4, 0.5), Vec3(1, 1, 1)})
    p.insert(p.begin(), more);
  Rng rng(5);
  for (int i = 0; i < 60; ++i) p.emplace_back(rng.uniform(0, 1), rng.uniform(0, 1), 1);
  const auto h = exact_hull(p);
  REQUIRE(h);
  for (const Vec3& v : p) CHECK(fuzz::contains(*h, v));
  CHECK(fuzz::is_closed({h->points, h->facets}));
  CHECK(std::abs(fuzz::volume_inside({h->points, h->facets}) - 1) < 1e-12);
  CHECK_FALSE(fuzz::contains(*h, {0.5, 0.5, after(1)}));
  CHECK_FALSE(exact_hull(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 7, 0}}));
  CHECK_FALSE(exact_hull(Points{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}));
  CHECK_FALSE(exact_hull(Points{{1, 2, 3}}));
}

TEST_CASE("pieces that share a face cover; a gap of one unit in the last place is found", "[cover]") {
  const TriangleMesh cube = surface(corners({0, 0, 0}, {1, 1, 1}));
  const double cut = 0.3;
  const Cover whole = covered(cube, {corners({0, 0, 0}, {cut, 1, 1}), corners({cut, 0, 0}, {1, 1, 1})});
  CHECK(whole.covers());
  CHECK_FALSE(whole.witness);
  CHECK(whole.sticks_out.bracket.hi == 0);
  const Cover split =
      covered(cube, {corners({0, 0, 0}, {cut, 1, 1}), corners({after(cut), 0, 0}, {1, 1, 1})});
  CHECK_FALSE(split.covers());
  CHECK(split.uncovered.size() == 8);
  REQUIRE(split.witness);
  const auto x = referee::rational_from_text(split.witness->exact[0]);
  CHECK(x > referee::exact(cut));
  CHECK(x < referee::exact(after(cut)));
}

TEST_CASE("a hole inside a triangle is found although its corners and edges are covered", "[cover]") {
  const fuzz::Triangle t{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  const auto box = [](double x0, double x1, double y0, double y1) {
    return *exact_hull(corners({x0, y0, -1}, {x1, y1, 1}));
  };
  const double a = 1, b = std::nextafter(1.0, 2.0);
  std::vector<ExactHull> around{box(-1, a, -1, 5), box(b, 5, -1, 5), box(0.5, 2, -1, a), box(0.5, 2, b, 5)};
  const auto hole = fuzz::uncovered_point(t, around);
  REQUIRE(hole);
  CHECK((hole->x > referee::exact(a) && hole->x < referee::exact(b)));
  CHECK((hole->y > referee::exact(a) && hole->y < referee::exact(b)));
  around.push_back(box(a, b, a, b));
  CHECK_FALSE(fuzz::uncovered_point(t, around));
}

TEST_CASE("triangles in a face, and flat triangles, are decided as they are", "[cover]") {
  const std::vector<ExactHull> pieces{*exact_hull(corners({0, 0, 0}, {1, 1, 1})),
                                      *exact_hull(corners({2, 0, 0}, {3, 1, 1}))};
  const auto is_covered = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return !fuzz::uncovered_point({a, b, c}, pieces);
  };
  CHECK(is_covered({0, 0, 1}, {1, 0, 1}, {0, 1, 1}));
  CHECK_FALSE(is_covered({0, 0, after(1)}, {1, 0, after(1)}, {0, 1, after(1)}));
  CHECK_FALSE(is_covered({0, 0, 1}, {after(1), 0, 1}, {0, 1, 1}));
  CHECK(is_covered({0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}));      // a segment
  CHECK_FALSE(is_covered({0.5, 0, 0}, {2.5, 0, 0}, {1, 0, 0}));  // one across the gap
  CHECK(is_covered({1, 1, 1}, {1, 1, 1}, {1, 1, 1}));            // a point
  CHECK_FALSE(is_covered({1.5, 0, 0}, {1.5, 0, 0}, {1.5, 0, 0}));
}

TEST_CASE("how far a mesh sticks out is bracketed to one per cent", "[cover]") {
  const TriangleMesh cube = surface(corners({-1, -1, -1}, {1, 1, 1}));
  const Cover smaller = covered(cube, {corners({-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9})});
  CHECK(smaller.uncovered.size() == 12);
  check_reach(smaller.sticks_out, 0.1 * std::numbers::sqrt3);
  // Two halves with a gap from -0.2 to 0.2: the middle of the gap, at the surface, is 0.2 away.
  const Cover halves =
      covered(cube, {corners({-1, -1, -1}, {-0.2, 1, 1}), corners({0.2, -1, -1}, {1, 1, 1})});
  check_reach(halves.sticks_out, 0.2);
  CHECK(std::abs(halves.sticks_out.at.x()) < 0.01);
}

TEST_CASE("how far pieces reach beyond a closed mesh is bracketed to one per cent", "[cover]") {
  const TriangleMesh cube = surface(corners({0, 0, 0}, {1, 1, 1}));
  const Cover larger = covered(cube, {corners({-0.1, -0.1, -0.1}, {1.1, 1.1, 1.1})});
  CHECK(larger.covers());
  REQUIRE(larger.reaches_beyond);
  check_reach(*larger.reaches_beyond, 0.1 * std::numbers::sqrt3);
  // The hull of a channel fills it: the middle of the open top is half the width from the walls.
  const TriangleMesh channel =
      prism({{-1, 0}, {1, 0}, {1, 1}, {0.25, 1}, {0.25, 0.25}, {-0.25, 0.25}, {-0.25, 1}, {-1, 1}},
            {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 5}, {0, 5, 7}, {5, 6, 7}});
  REQUIRE(fuzz::is_closed(channel));
  CHECK(std::abs(fuzz::volume_inside(channel) - 2 * (2 - 0.5 * 0.75)) < 1e-12);
  const Cover filled = covered(channel, {channel.vertices});
  CHECK(filled.covers());
  REQUIRE(filled.reaches_beyond);
  check_reach(*filled.reaches_beyond, 0.25);
  CHECK(filled.union_volume.lo <= 4);
  CHECK(filled.union_volume.hi >= 4);
  REQUIRE(filled.mesh_volume);
  CHECK(std::abs(*filled.mesh_volume - 3.25) < 1e-12);
  const Cover exact =
      covered(channel, {corners({-1, -1, 0}, {-0.25, 1, 1}), corners({-0.25, -1, 0}, {0.25, 1, 0.25}),
                        corners({0.25, -1, 0}, {1, 1, 1})});
  CHECK(exact.covers());
  CHECK(exact.reaches_beyond->bracket.hi < 1e-8);
}

TEST_CASE("the volume of a union counts what pieces share once", "[cover]") {
  const std::atomic<bool> stop{false};
  const auto volume = [&](const std::vector<Points>& pieces) {
    std::vector<ExactHull> hulls;
    for (const Points& p : pieces) hulls.push_back(*exact_hull(p));
    return fuzz::volume_of_union(hulls, stop);
  };
  const auto check = [](const referee::Bracket& b, double truth) {
    INFO(b.lo << " " << truth << " " << b.hi);
    CHECK(b.lo <= truth);
    CHECK(b.hi >= truth);
    CHECK(b.hi - b.lo < 2e-3 * truth);
  };
  check(volume({corners({0, 0, 0}, {1, 1, 1})}), 1);
  check(volume({corners({0, 0, 0}, {1, 1, 1}), corners({0.3, 0.4, 0.5}, {1.3, 1.4, 1.5})}),
        2 - 0.7 * 0.6 * 0.5);
  check(volume({corners({0, 0, 0}, {1, 1, 1}), corners({0.2, 0.2, 0.2}, {0.7, 0.6, 0.8})}), 1);
  // Two tetrahedra in one cube; they share an octahedron of a sixth of it.
  check(volume({{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}, {{1, 1, 1}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}}}),
        0.5);
}

TEST_CASE("an open mesh has no inside, and a flat piece is refused by name", "[cover]") {
  TriangleMesh open = surface(corners({0, 0, 0}, {1, 1, 1}));
  open.triangles.pop_back();
  const Cover c = covered(open, {corners({0, 0, 0}, {1, 1, 1})});
  CHECK(c.covers());
  CHECK_FALSE(c.closed);
  CHECK_FALSE(c.reaches_beyond);
  CHECK_FALSE(c.mesh_volume);
  try {
    covered(open, {corners({0, 0, 0}, {1, 1, 0})});
    FAIL("accepted");
  } catch (const InputError& e) {
    CHECK(std::string(e.what()).find("piece: is flat") != std::string::npos);
  }
}

TEST_CASE("random decompositions: what is taken from a cover is missed", "[cover]") {
  Rng rng(11);
  for (int round = 0; round < 20; ++round) {
    const double x = rng.uniform(0.4, 0.6), y = rng.uniform(0.4, 0.6), z = rng.uniform(0.4, 0.6);
    std::vector<Points> pieces;
    for (int i = 0; i < 8; ++i)
      pieces.push_back(corners({(i & 1) != 0 ? x : 0, (i & 2) != 0 ? y : 0, (i & 4) != 0 ? z : 0},
                               {(i & 1) != 0 ? 1 : x, (i & 2) != 0 ? 1 : y, (i & 4) != 0 ? 1 : z}));
    Points ball;
    for (int i = 0; i < 30; ++i) {
      const Vec3 d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
      ball.push_back(Vec3::Constant(0.5) + 0.49 * d.normalized());
    }
    const TriangleMesh mesh = surface(ball);
    const auto witness = [&] {
      std::vector<ExactHull> hulls;
      for (const Points& p : pieces) hulls.push_back(*exact_hull(p));
      for (const auto& t : mesh.triangles) {
        const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
        if (const auto found = fuzz::uncovered_point({at(0), at(1), at(2)}, hulls)) return found;
      }
      return std::optional<referee::Rational3>();
    };
    CHECK_FALSE(witness());
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(rng.below(8)));
    const auto found = witness();
    REQUIRE(found);
    const Vec3 rounded(static_cast<double>(found->x), static_cast<double>(found->y),
                       static_cast<double>(found->z));
    for (const Points& p : pieces) CHECK_FALSE(fuzz::contains(*exact_hull(p), rounded));
  }
}
