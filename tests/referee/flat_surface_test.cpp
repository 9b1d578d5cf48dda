// Where a mesh is a plane as far as a body reaches, it has a least depth.
#include "oracles/referee/region/contact_region.h"

#include <cmath>

#include "core/math/rng.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

// n x n tiles of two triangles over [-1, 1]².
TriangleMesh floor_of(int n) {
  TriangleMesh m;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) m.vertices.push_back({2.0 * i / n - 1, 2.0 * j / n - 1, 0});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      m.triangles.push_back({a, b, b + 1});
      m.triangles.push_back({a, b + 1, a + 1});
    }
  return m;
}

std::optional<referee::FlatSurface> flat(const Shape& mesh, const Shape& body, const Vec3& at,
                                         const Pose& of_mesh = {}) {
  return referee::flat_surface({&mesh, of_mesh}, {&body, Pose{at, Quat{}}});
}

bool overlaps(const Placed& a, const Placed& b) {
  return referee::judge_pair(a, b).verdict == referee::Verdict::overlap;
}

Shape body_of(int kind) {
  if (kind == 0) return Sphere{0.25};
  if (kind == 1) return Box{{0.02, 0.125, 0.25}};
  if (kind == 2) return Cylinder{0.125, 0.25};
  return make_hull({{0.2, 0, 0}, {-0.2, 0, 0}, {0, 0.1, 0}, {0, -0.1, 0}, {0, 0, 0.3}, {0, 0, -0.2}});
}

}  // namespace

TEST_CASE("a body leaves a flat mesh across it by the reach, and no other way by less than is said",
          "[referee][mesh][flat]") {
  int tried = 0;
  for (int i = 0; i < 40; ++i) {
    Rng rng = Rng::stream(7, static_cast<std::uint64_t>(i));
    const Shape mesh = floor_of(4 + i % 5), body = body_of(i % 4);
    const Pose of_mesh{rng.unit_vector(), rng.rotation()};
    const Mat3 turn = rotation_matrix(of_mesh.rotation);
    const Vec3 local(rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2), rng.uniform(-0.1, 0.1));
    const Placed floor{&mesh, of_mesh};
    const Pose pose{turn * local + of_mesh.translation, rng.rotation()};
    const auto r = referee::flat_surface(floor, {&body, pose});
    if (!r) continue;
    CHECK(std::abs(std::abs(r->normal.dot(turn.col(2))) - 1) < 1e-14);
    CHECK(r->reach.hi - r->reach.lo < 1e-12);
    const auto moved = [&](const Vec3& by) {
      return Placed{&body, Pose{pose.translation + by, pose.rotation}};
    };
    const double across = r->reach.hi * (1 + 1e-9);
    CHECK((!overlaps(floor, moved(across * r->normal)) || !overlaps(floor, moved(-across * r->normal))));
    for (int k = 0; k < 20; ++k) {
      const Vec3 n = rng.unit_vector();
      const double least = std::min(r->reach.lo / std::abs(n.dot(r->normal)), 2 * r->reach.lo);
      CHECK(overlaps(floor, moved(least * (1 - 1e-9) * n)));
      ++tried;
    }
  }
  CHECK(tried >= 400);
}

TEST_CASE("a mesh is not a plane to a body near its border, a bend, a gap or a junction",
          "[referee][mesh][flat]") {
  const Shape ball = Sphere{0.25};
  const Vec3 middle(0.03, 0.06, 0.2);  // reaches 0.05 below
  const TriangleMesh whole = floor_of(4);
  REQUIRE(flat(whole, ball, middle));
  CHECK(flat(whole, ball, middle)->reach.hi >= 0.05);
  CHECK_FALSE(flat(whole, ball, {0.03, 0.06, 0.3}));  // apart
  CHECK_FALSE(flat(whole, ball, {0.9, 0.06, 0.2}));   // the border is within twice its reach
  CHECK_FALSE(flat(whole, HalfSpace{{0, 0, -1}, 0}, {0, 0, 0}));
  CHECK_FALSE(flat(whole, whole, {0, 0, 0}));

  TriangleMesh bent = whole;
  bent.vertices[12].z() = 0x1p-60;  // the middle vertex, by less than a rounding
  CHECK_FALSE(flat(bent, ball, middle));
  TriangleMesh bent_far = whole;
  bent_far.vertices[0].z() = 0.5;  // a corner, out of reach
  CHECK(flat(bent_far, ball, middle));

  TriangleMesh gap = whole;
  gap.triangles.erase(gap.triangles.begin() + 12);
  CHECK_FALSE(flat(gap, ball, middle));

  TriangleMesh wall = whole;
  const int first = static_cast<int>(wall.vertices.size());
  for (const Vec3& v : {Vec3(0.3, -1, 0.1), Vec3(0.3, 1, 0.1), Vec3(0.3, 0, 1)}) wall.vertices.push_back(v);
  wall.triangles.push_back({first, first + 1, first + 2});
  CHECK_FALSE(flat(wall, ball, middle));
  for (int k = 0; k < 3; ++k) wall.vertices[static_cast<std::size_t>(first + k)].x() = 0.9;
  CHECK(flat(wall, ball, middle));

  // One triangle on one side of an edge, two on the other: covered, but not shown by matching edges.
  const TriangleMesh junction{{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 0}},
                              {{0, 1, 2}, {0, 4, 3}, {4, 1, 3}}};
  CHECK_FALSE(flat(junction, Sphere{0.1}, {0.02, 0.02, 0.09}));
}
