// Points, segments, polygons: legitimate closed sets without volume.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

TriangleMesh square() { return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

// The square [-1, 1]² in tiles of 1/4, each of two triangles.
TriangleMesh tiled_floor() {
  constexpr int tiles = 8;
  TriangleMesh m;
  for (int i = 0; i <= tiles; ++i)
    for (int j = 0; j <= tiles; ++j) m.vertices.push_back({i / 4.0 - 1, j / 4.0 - 1, 0});
  for (int i = 0; i < tiles; ++i)
    for (int j = 0; j < tiles; ++j) {
      const int a = i * (tiles + 1) + j, b = a + tiles + 1;
      m.triangles.push_back({a, b, b + 1});
      m.triangles.push_back({a, b + 1, a + 1});
    }
  return m;
}

Expectation overlaps_only(std::string reason) {
  Expectation e;
  e.overlap = true;
  e.reason = std::move(reason);
  return e;
}

}  // namespace

List degenerate_flat() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const Box unit{Vec3(1, 1, 1)}, tile{Vec3(1, 1, 0)};
  const Hull triangle = make_hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  return {
      pair("degenerate", "same_point_twice", "two spheres of radius 0 at the same place",
           {Sphere{0}, at(1, 2, 3), {}}, {Sphere{0}, at(1, 2, 3), {}},
           gap_is(0, 0, x, "a closed set shares a point with itself")),
      pair("degenerate", "point_in_box", "a sphere of radius 0 inside a box", {unit, {}, {}},
           {Sphere{0}, at(0.5, 0.25, 0), {}}, gap_is(-0.5, 0, x, "1 - 0.5")),
      pair("degenerate", "vertex_hull_on_face", "a hull of one point on a face", {unit, {}, {}},
           {make_hull({{1, 0.25, 0.5}}), {}, {}}, gap_is(0, 0, x, "the point lies on x = 1")),
      pair("degenerate", "segments_cross", "two hulls of two points cross at the origin",
           {make_hull({{-1, 0, 0}, {1, 0, 0}}), {}, {}}, {make_hull({{0, -1, 0}, {0, 2, 0}}), {}, {}},
           gap_is(0, 0, z, "both contain the origin and lie in z = 0")),
      pair("degenerate", "segments_skew", "two hulls of two points pass at distance 1/2",
           {make_hull({{-1, 0, 0}, {1, 0, 0}}), {}, {}},
           {make_hull({{0, -1, 0}, {0, 2, 0}}), at(0, 0, 0.5), {}},
           gap_is(0.5, 0, z, "parallel planes z = 0 and z = 0.5")),
      pair("degenerate", "collinear_points", "five collinear points against a ball",
           {make_hull({{-2, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), {}, {}},
           {Sphere{1}, at(0, 3, 4), {}}, gap_is(4, 0, Vec3(0, 0.6, 0.8), "|(3,4)| - 1")),
      pair("degenerate", "squares_cross", "two flat boxes cut each other through the middle", {tile, {}, {}},
           {tile, at(0, 0, 0, quarter_turn_x), {}}, gap_is(-1, 0, z, "w(n) = 2|nx| + |ny| + |nz|")),
      pair("degenerate", "tile_on_cube", "a flat box lies on a face", {unit, {}, {}},
           {tile, at(0.5, 0, 1), {}}, gap_is(0, 0, z, "plane z = 1")),
      pair("degenerate", "tiles_coplanar_overlapping", "two flat boxes in one plane overlap in an area",
           {tile, {}, {}}, {tile, at(1, 0.5, 0), {}},
           gap_is(0, 0, z, "no extent along z: depth 0, although they share a rectangle")),
      pair("degenerate", "triangle_under_ball", "a flat hull", {triangle, {}, {}},
           {Sphere{1}, at(1, 1, 1.5), {}}, gap_is(0.5, 0, z, "1.5 - 1 above the interior")),
      pair("degenerate", "triangle_beside_ball", "the nearest point of a flat hull is on its edge",
           {triangle, {}, {}}, {Sphere{1}, at(1, -3, 4), {}},
           gap_is(4, 0, Vec3(0, -0.6, 0.8), "|(3,4)| from the edge y = 0, minus 1")),
      pair("degenerate", "segment_through_box", "a capsule of radius 0 pierces a box", {unit, {}, {}},
           {Capsule{0, 2}, {}, {}}, gap_is(-1, 0, y, "1 across; 3 along")),
      pair("degenerate", "disc_on_ball", "a cylinder of height 0 on top of a ball", {Sphere{1}, {}, {}},
           {Cylinder{2, 0}, at(0, 0, 1), {}}, gap_is(0, 0, z, "plane z = 1")),
      pair("degenerate", "mesh_diagonal_under_ball", "a ball above the inner edge of a two-triangle mesh",
           {square(), {}, {}}, {Sphere{0.5}, at(0, 0, 1), {}}, gap_is(0.5, 0, z, "1 - 0.5")),
      pair("degenerate", "mesh_cut_by_box", "a box through a surface", {square(), {}, {}},
           {Box{Vec3(0.25, 0.25, 0.5)}, at(0.25, 0.125, 0.25), {}},
           overlaps_only(
               "the origin's neighbourhood of z = 0 lies in the box; depth of a surface is not defined")),
      pair("degenerate", "ball_across_inner_edges",
           "a ball on coplanar triangles: its normal is none of an edge", {tiled_floor(), {}, {}},
           {Sphere{0.5}, at(0.0625, 0.03125, 0.4375), {}},
           overlaps_only("the ball reaches 1/16 below z = 0, on a disc across several triangles")),
      pair("degenerate", "plate_through_tiled_floor",
           "a thin upright plate: each triangle alone is left sideways, the floor only upward",
           {tiled_floor(), {}, {}}, {Box{Vec3(0.015625, 0.25, 0.25)}, at(0.0625, 0.03125, 0.125), {}},
           overlaps_only("the plate reaches 1/8 below z = 0, and 1/4 is needed to leave a tile along x")),
      pair("degenerate", "mesh_touched_by_corner", "a box corner touches a surface", {square(), {}, {}},
           {Box{Vec3(1, 1, 1)}, at(1.5, 1.5, 1), {}},
           gap_is(0, 0, z, "face z = 0 on face z = 0, over a quarter square")),
  };
}

}  // namespace touchstone::scenarios
