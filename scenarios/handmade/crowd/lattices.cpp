// Many equal bodies on a lattice: every interval end is tied with others, and pair counts have closed forms.
// Neighbour counts of an nx·ny·nz lattice: along x (nx-1)·ny·nz; diagonals in a plane 2·(nx-1)·(ny-1)·nz; in
// space 4·(nx-1)·(ny-1)·(nz-1).
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

struct Lattice {
  int nx, ny, nz;
  Vec3 spacing;
  Vec3 origin = Vec3::Zero();
};

Scene lattice(const Shape& shape, const Lattice& l) {
  Scene s;
  s.shapes = {shape};
  for (int i = 0; i < l.nx; ++i)
    for (int j = 0; j < l.ny; ++j)
      for (int k = 0; k < l.nz; ++k) {
        Body b;
        b.pose.translation = l.origin + l.spacing.cwiseProduct(Vec3(i, j, k));
        s.bodies.push_back(b);
      }
  return s;
}

Scene with_outlier() {
  Scene s = lattice(Sphere{0.5}, {5, 5, 4, Vec3(1, 1, 1)});
  Body far;
  far.pose.translation = Vec3(0x1p60, -0x1p60, 0x1p60);
  s.bodies.push_back(far);
  return s;
}

Scene row_with_filters() {
  Scene s = lattice(Box{Vec3(0.5, 0.5, 0.5)}, {6, 1, 1, Vec3(1, 1, 1)});
  s.bodies[0].group = s.bodies[1].group = 0;
  s.bodies[2].group = s.bodies[3].group = 7;
  s.ignored = {{4, 5}};
  return s;
}

}  // namespace

List crowd_lattices() {
  const Box half{Vec3(0.5, 0.5, 0.5)};
  return {
      scenario("crowd", "thousand_balls", "the worked example: what a broad phase saves",
               lattice(Sphere{0.5}, {10, 10, 10, Vec3(0.75, 0.75, 1.25)}),
               // Boxes of width 1 meet at offsets (0.75, 0), (0, 0.75), (0.75, 0.75) of one layer; layers
               // are 1.25 apart. Balls meet along the axes only: 0.75·sqrt2 > 1.
               counts(499500, 3420, 1800, "all pairs 1000·999/2; boxes 10·(2·90 + 2·81); balls 10·2·90")),
      scenario("crowd", "cubes_fill_space", "every cube touches its 26 neighbours",
               lattice(half, {4, 4, 4, Vec3(1, 1, 1)}),
               counts(2016, 468, 468, "3·48 faces + 3·72 edges + 108 corners")),
      scenario("crowd", "tiles_fill_a_plane", "boxes without thickness",
               lattice(Box{Vec3(0.5, 0.5, 0)}, {5, 5, 1, Vec3(1, 1, 1)}),
               counts(300, 72, 72, "2·20 edges + 2·16 corners")),
      scenario("crowd", "all_in_one_place", "twenty identical bodies at one point",
               lattice(half, {20, 1, 1, Vec3(0, 0, 0)}), counts(190, 190, 190, "20·19/2")),
      scenario("crowd", "points_in_one_place", "balls of radius 0 at one point",
               lattice(Sphere{0}, {12, 1, 1, Vec3(0, 0, 0)}), counts(66, 66, 66, "12·11/2")),
      scenario("crowd", "one_far_outlier", "quantised extents collapse when one body is 2^60 away",
               with_outlier(),
               counts(5050, 795, 235,
                      "faces 80+80+75, edges 128+120+120, corners 192; balls meet along axes only")),
      scenario("crowd", "around_the_origin", "cell borders at negative coordinates and at zero",
               lattice(Sphere{0.25}, {5, 5, 5, Vec3(1, 1, 1), Vec3(-2, -2, -2)}),
               counts(7750, 0, 0, "1 apart, width 0.5")),
      scenario("crowd", "touching_around_the_origin", "the same, touching exactly",
               lattice(half, {5, 5, 5, Vec3(1, 1, 1), Vec3(-2, -2, -2)}),
               counts(7750, 1036, 1036, "3·100 faces + 3·160 edges + 256 corners")),
      scenario("crowd", "row_with_filters", "groups and ignored pairs are never overlapping pairs",
               row_with_filters(),
               counts(15, 5, 2, "five touching neighbours; (0,1) and (2,3) are groups, (4,5) is ignored")),
  };
}

}  // namespace touchstone::scenarios
