// Hill climbing along a hull's edges against checking all its vertices: the same vertex for every direction.
#include <algorithm>
#include <cmath>

#include "core/math/rng.h"
#include "core/narrow/narrow_phase.h"
#include "core/shape/hull_graph.h"
#include "core/shape/vertex_climb.h"
#include "core/shape/vertex_scan.h"
#include "tests/core/least_width.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

Hull on_ellipsoid(Rng& r, int n, const Vec3& axes) {
  std::vector<Vec3> v;
  for (int i = 0; i < n; ++i) v.push_back(axes.cwiseProduct(r.unit_vector()));
  return make_hull(std::move(v));
}

// Points of a lattice within a ball: faces of many exactly coplanar vertices, many points inside and on them.
Hull lattice_ball(int radius) {
  std::vector<Vec3> v;
  for (int x = -radius; x <= radius; ++x)
    for (int y = -radius; y <= radius; ++y)
      for (int z = -radius; z <= radius; ++z)
        if (x * x + y * y + z * z <= radius * radius) v.push_back(Vec3(x, y, z));
  Hull h = make_hull(v);
  // Only its corners: points on faces would leave it without a graph.
  std::vector<char> used(v.size(), 0);
  for (const auto& f : h.faces)
    for (const int i : f) used[static_cast<std::size_t>(i)] = 1;
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < v.size(); ++i)
    if (used[i]) kept.push_back(v[i]);
  return make_hull(std::move(kept));
}

// Two parallel polygons with integer corners, each exactly coplanar.
Hull prism(int n, double height) {
  std::vector<Vec3> v;
  for (int i = 0; i < n; ++i)
    for (const double z : {-height, height})
      v.push_back(Vec3(std::round(4096 * std::cos(6.283185307 * i / n)),
                       std::round(4096 * std::sin(6.283185307 * i / n)), z));
  return make_hull(std::move(v));
}

// Directions with ties, near ties, or none.
template <class R>
V3<R> direction(Rng& r, const Hull& h) {
  const auto& f = h.faces[r.below(h.faces.size())];
  const auto v = [&](std::size_t k) -> const Vec3& { return h.vertices[static_cast<std::size_t>(f[k])]; };
  const Vec3 n = (v(1) - v(0)).cross(v(2) - v(0)).normalized();
  Vec3 d = r.unit_vector();
  switch (r.below(5)) {
    case 0:
      d = n;
      break;
    case 1:
      d = n + d * std::ldexp(1.0, -static_cast<int>(r.below(60)));
      break;
    case 2:
      d = Vec3::Unit(static_cast<int>(r.below(3))) * (r.chance(0.5) ? 1 : -1);
      break;
    case 3:
      d = (v(1) - v(0)).cross(d);
      break;
    default:
      break;
  }
  return (d * std::ldexp(1.0, static_cast<int>(r.below(40)) - 20)).template cast<R>();
}

template <class R>
void check_directions(Rng& r, const Hull& h, const HullGraph& g, int n) {
  for (int i = 0; i < n; ++i) {
    const V3<R> d = direction<R>(r, h);
    const std::size_t all = convex::farthest_vertex(h.vertices, d),
                      climbed = convex::farthest_vertex(g, h.vertices, d);
    INFO("direction " << i << ": " << d.transpose() << " of " << h.vertices.size() << " vertices");
    REQUIRE(all == climbed);
  }
}

// Whether the hull has a graph.
bool check_hull(Rng& r, const Hull& h) {
  const HullGraph g = build_hull_graph(h, 4);
  if (!g) return false;
  check_directions<double>(r, h, g, 2000);
  check_directions<float>(r, h, g, 2000);
  return true;
}

}  // namespace

TEST_CASE("hill climbing finds the same vertex as checking all of them", "[narrow][hull]") {
  Rng r(71);
  int thin = 0;
  for (const int n : {4, 8, 33, 128, 600, 2000}) {
    CHECK(check_hull(r, on_ellipsoid(r, n, Vec3(1, 1, 1))));
    CHECK(check_hull(r, on_ellipsoid(r, n, Vec3(1, 0.01, 3))));
    // So thin that rounding may drop some of its vertices, and the graph with them.
    thin += check_hull(r, on_ellipsoid(r, n, Vec3(1, 1, 1e-7)));
    thin += check_hull(r, on_ellipsoid(r, n, Vec3(1e-3, 1e3, 1)));
  }
  CHECK(thin >= 6);
  for (const int radius : {1, 3, 7}) CHECK(check_hull(r, lattice_ball(radius)));
}

TEST_CASE("a face with more vertices than are compared is checked completely", "[narrow][hull]") {
  Rng r(72);
  const Hull h = prism(100, 512);
  const HullGraph g = build_hull_graph(h, 4);
  REQUIRE(g);
  check_directions<double>(r, h, g, 4000);
  check_directions<float>(r, h, g, 4000);
}

TEST_CASE("a hull keeps its graph only if its unused vertices are deep inside", "[narrow][hull]") {
  Rng r(73);
  Hull h = on_ellipsoid(r, 200, Vec3(1, 2, 3));
  auto v = h.vertices;
  for (int i = 0; i < 50; ++i) v.insert(v.begin(), 0.5 * r.unit_vector());
  const Hull padded = make_hull(v);
  CHECK(check_hull(r, padded));
  v.push_back(v.back());
  CHECK_FALSE(build_hull_graph(make_hull(v), 4));
  v.back() = (v[100] + v[101]) / 2;
  const bool inside = static_cast<bool>(build_hull_graph(make_hull(v), 4));
  CHECK(inside == ((v[100] - v[101]).norm() > 0.5));
}

TEST_CASE("a hull that is small, flat, or not convex to the last bit has no graph", "[narrow][hull]") {
  Rng r(74);
  CHECK_FALSE(build_hull_graph(on_ellipsoid(r, 255, Vec3(1, 1, 1))));
  CHECK_FALSE(build_hull_graph(on_ellipsoid(r, 300, Vec3(1, 1, 0))));
  Hull h = on_ellipsoid(r, 300, Vec3(1, 1, 1));
  REQUIRE(build_hull_graph(h));
  Hull turned = h, missing = h, twice = h, dented = h;
  std::swap(turned.faces[7][0], turned.faces[7][1]);
  CHECK_FALSE(build_hull_graph(turned));
  missing.faces.pop_back();
  CHECK_FALSE(build_hull_graph(missing));
  twice.faces.insert(twice.faces.end(), h.faces.begin(), h.faces.end());
  CHECK_FALSE(build_hull_graph(twice));
  dented.vertices[5] *= 0.9;
  CHECK_FALSE(build_hull_graph(dented));
  // Inside out.
  for (auto& f : h.faces) std::swap(f[0], f[1]);
  CHECK_FALSE(build_hull_graph(h));
}

TEST_CASE("answers are the same with and without a graph", "[narrow][hull]") {
  Rng r(75);
  long overlaps = 0;
  for (int i = 0; i < 60; ++i) {
    const Shape a = on_ellipsoid(r, 200, Vec3(1, 0.7, 1.2)),
                b = i % 3 == 0 ? Shape(Box{{0.5, 0.7, 0.9}}) : Shape(on_ellipsoid(r, 150, Vec3(0.8, 1, 0.6)));
    const Collider ca(a, 4), cb(b, 4);
    const Pose pa{r.unit_vector(), r.rotation()}, pb{r.unit_vector() * r.uniform(0, 3), r.rotation()};
    const PlacedShape a0{&a, pa}, b0{&b, pb}, a1 = ca.at(pa), b1 = cb.at(pb);
    for (const Arithmetic f : {Arithmetic::float64, Arithmetic::float32}) {
      const DistanceAnswer d0 = distance(a0, b0, f), d1 = distance(a1, b1, f);
      CHECK((d0.distance == d1.distance && d0.normal == d1.normal && d0.witness == d1.witness));
      const ContactAnswer c0 = contact(b0, a0, f), c1 = contact(b1, a1, f);
      CHECK((c0.overlap == c1.overlap && c0.depth == c1.depth && c0.normal == c1.normal));
      CHECK(c0.manifold.size() == c1.manifold.size());
      CHECK(overlap(a0, b0, f).overlap == overlap(a1, b1, f).overlap);
      overlaps += c0.overlap;
    }
  }
  CHECK((overlaps > 20 && overlaps < 100));
}

TEST_CASE("hulls of a thousand vertices about one centre have a depth", "[narrow][hull]") {
  Rng rng(9);
  for (const int vertices : {300, 1000, 2000}) {
    Hull x, y;
    for (int i = 0; i < vertices; ++i) {
      x.vertices.push_back(rng.unit_vector());
      y.vertices.push_back(rng.unit_vector());
    }
    const Shape a = x, b = y;
    const Pose at{Vec3(0, 0, 0), rng.rotation()};
    const ContactAnswer c = contact({&a, Pose{}}, {&b, at});
    CAPTURE(vertices);
    REQUIRE(c.outcome == Outcome::answered);
    // Nearly two balls; more vertices cut off less of them.
    CHECK(c.depth > 1.85);
    CHECK(c.depth < 2);
    CHECK(std::abs(static_cast<double>(test::Width(a, Pose{}, b, at)(c.normal.cast<Wide>())) - c.depth) <
          1e-14);
  }
}

TEST_CASE("the manifold of a face with many corners covers it", "[narrow][hull]") {
  // 64 corners lie on a box: their polygon has 0.5 % more area than that of the 32 that are kept. At depth 0
  // extended precision answers.
  const Hull h = prism(64, 512);
  REQUIRE(build_hull_graph(h, 4));
  const Shape wheel = h, floor = Box{{8192, 8192, 100}};
  const Collider climbed(wheel, 4), scanned(wheel, Collider::no_graph);
  const PlacedShape below{&floor, {Vec3(0, 0, -100), Quat{}}};
  for (const Collider* collider : {&climbed, &scanned})
    for (const double depth : {0.0, 0.5, 1.0}) {
      const ContactAnswer c = contact(below, collider->at({Vec3(0, 0, 512 - depth), Quat{}}));
      REQUIRE(c.overlap);
      CHECK(c.depth == Approx(depth).margin(1e-9));
      double area = 0;
      const auto n = c.manifold.size();
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 &p = c.manifold[i].position, &q = c.manifold[(i + 1) % n].position;
        area += (p.x() * q.y() - p.y() * q.x()) / 2;
      }
      CHECK(std::abs(area) > 0.99 * 3.14159 * 4096 * 4096);
    }
}
