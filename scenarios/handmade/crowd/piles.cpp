// Many unequal bodies: ground planes, walls, one of each shape.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

// n·n copies of `shape` at `height`, `spacing` apart, over `ground`.
Scene on_ground(const Shape& ground, const Shape& shape, int n, double spacing, double height) {
  std::vector<Part> parts{{ground, {}, {}}};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      parts.push_back({shape, at(spacing * (i - n / 2), spacing * (j - n / 2), height), {}});
  return scene_of("", std::move(parts));
}

// (n+1)² vertices one apart around the origin, two triangles per cell.
TriangleMesh grid_mesh(int n) {
  TriangleMesh m;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) m.vertices.emplace_back(i - n / 2, j - n / 2, 0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      m.triangles.push_back({a, b, b + 1});
      m.triangles.push_back({a, b + 1, a + 1});
    }
  return m;
}

// Bricks 2×1×1; every second course is shifted by half a brick.
Scene brick_wall(int courses, int bricks) {
  std::vector<Part> parts;
  for (int k = 0; k < courses; ++k)
    for (int i = 0; i < bricks; ++i) parts.push_back({Box{Vec3(1, 0.5, 0.5)}, at(2 * i + k % 2, 0, k), {}});
  return scene_of("", std::move(parts));
}

Scene one_of_each() {
  std::vector<Shape> shapes{Sphere{1},
                            Box{Vec3(1, 1, 1)},
                            Capsule{0.5, 1},
                            Cylinder{0.5, 1},
                            Cone{0.5, 1},
                            Ellipsoid{Vec3(1, 2, 1)},
                            make_hull({{1, 0, 0}, {-1, 1, 0}, {-1, -1, 1}, {0, 0, -1}}),
                            HalfSpace{Vec3(0, 1, 1), 0}};
  std::vector<Part> parts;
  for (Shape& s : shapes) parts.push_back({std::move(s), {}, {}});
  return scene_of("", std::move(parts));
}

}  // namespace

List crowd_piles() {
  const Box cube{Vec3(0.5, 0.5, 0.5)};
  return {
      scenario("crowd", "cubes_on_a_wide_floor", "one box under all others",
               on_ground(Box{Vec3(64, 64, 1)}, cube, 8, 2, 1.5),
               counts(2080, 64, 64, "64 cubes rest on the floor, 1 apart from each other")),
      scenario("crowd", "balls_on_a_half_space", "an infinite box among finite ones",
               on_ground(HalfSpace{Vec3(0, 0, 1), 0}, Sphere{0.5}, 7, 1.5, 0.5),
               counts(1225, 49, 49, "49 balls touch the plane, 0.5 apart from each other")),
      scenario(
          "crowd", "balls_above_a_half_space", "the same, lifted by 2^-20",
          on_ground(HalfSpace{Vec3(0, 0, 1), 0}, Sphere{0.5}, 7, 1.5, 0.5 + 0x1p-20),
          counts(1225, 0, 0, "the half-space ends at z = 0; its box must too, or it adds false candidates")),
      scenario("crowd", "boxes_on_a_mesh", "boxes stand on the vertices of a mesh",
               on_ground(grid_mesh(4), Box{Vec3(0.25, 0.25, 0.25)}, 3, 1, 0.25),
               counts(45, 9, 9, "nine boxes touch the surface, 0.5 apart from each other")),
      scenario("crowd", "brick_wall", "running bond: every contact is exact", brick_wall(4, 5),
               counts(190, 43, 43, "4 courses of 4 joints, 3 beds of 9")),
      scenario("crowd", "one_of_each", "every convex shape and a half-space in one place", one_of_each(),
               counts(28, 28, 28, "all contain the origin")),
  };
}

}  // namespace touchstone::scenarios
