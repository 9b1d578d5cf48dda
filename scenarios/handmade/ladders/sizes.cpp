// Scale, distance from the origin, ratios of sizes, slender and thin shapes.
#include "scenarios/handmade/ladders/parts.h"

namespace touchstone::scenarios {
namespace {

// Sizes that are multiples of s.
Scene skew_boxes(double s, const Vec3& offset) {
  const Vec3 o(0.875, 0.75, 1.125);
  const Vec3 b = offset + o * s;
  return two(Box{Vec3(1, 0.75, 0.5) * s}, at(offset.x(), offset.y(), offset.z(), skew_turn),
             Box{Vec3(0.5, 1, 0.625) * s}, at(b.x(), b.y(), b.z(), other_turn));
}
Scene skew_boxes_scaled(double s) { return skew_boxes(s, Vec3::Zero()); }
Scene boxes_apart_scaled(double s) {
  return two(Box{Vec3(1, 0.75, 0.5) * s}, at(0, 0, 0, skew_turn), Box{Vec3(0.5, 1, 0.625) * s},
             at(2.5 * s, 0.75 * s, 0.5 * s, other_turn));
}
Scene sphere_box_scaled(double s) { return two(cube_of(s), {}, Sphere{s / 2}, at(1.25 * s, 0, 1.25 * s)); }
Scene capsules_scaled(double s) {
  return two(Capsule{s / 2, s}, {}, Capsule{s / 4, s}, at(s / 2, s / 8, 0, quarter_turn_x));
}
Scene cylinder_box_scaled(double s) {
  return two(cube_of(s), {}, Cylinder{s / 2, s}, at(s / 8, 0, 1.75 * s, about_y(0.25)));
}
Scene skew_boxes_far(double d) { return skew_boxes(1, Vec3(d, -d / 2, d / 4)); }
Scene faces_far(double d) { return two(cube_of(0.5), at(d, d, d), cube_of(0.5), at(d, d, d + 0.9375)); }
Scene gap_far(double d) { return two(cube_of(0.5), at(d, d, d), Sphere{0.5}, at(d, d, d + 1.0625)); }

Scene cube_at_corner(double ratio) {
  return two(cube_of(ratio), {}, cube_of(1), at(ratio + 0.75, ratio + 0.75, ratio + 0.75));
}
Scene sphere_on_large_box(double ratio) {
  return two(Box{Vec3(ratio, ratio, 1)}, {}, Sphere{1}, at(ratio / 2, ratio / 4, 1.9375));
}
Scene large_sphere(double ratio) { return two(Sphere{ratio}, {}, cube_of(1), at(0, 0, ratio + 0.9375)); }

Scene rods_crossed(double aspect) {
  return two(Box{Vec3(aspect, 1, 1)}, {}, Box{Vec3(aspect, 1, 1)}, at(0.5, 0.25, 1.875, quarter_turn_z));
}
Scene rod_cylinders_crossed(double aspect) {
  return two(Cylinder{1, aspect}, at(0, 0, 0, quarter_turn_y), Cylinder{1, aspect},
             at(0.5, 0.25, 1.875, quarter_turn_x));
}
Scene capsule_over_box(double aspect) {
  return two(cube_of(1), {}, Capsule{0.5, aspect}, at(0.25, aspect / 2, 1.4375, quarter_turn_x));
}
Scene plates_overlapping(double thickness) {
  return two(Box{Vec3(2, 2, thickness)}, {}, Box{Vec3(1, 1, thickness)}, at(0.25, 0, 1.5 * thickness));
}
Scene plates_crossed(double thickness) {
  return two(Box{Vec3(2, 2, thickness)}, {}, Box{Vec3(1, thickness, 1)}, at(0.25, 0.5, 0.875));
}
Scene plate_under_disc(double thickness) {
  return two(Box{Vec3(1, 1, thickness)}, {}, Cylinder{0.5, thickness}, at(0.25, 0, 2.5 * thickness));
}

Scene near_margin(double s) { return two(cube_of(s), {}, cube_of(s), at(0, s / 4, 2.25 * s)); }
Scene hull_near_margin(double s) {
  return two(cube_of(s), {}, make_hull({{s, 0, 0}, {-s, 0, 0}, {0, s, 0}, {0, -s, 0}, {0, 0, s}, {0, 0, -s}}),
             at(0, s / 4, 2.25 * s));
}
Scene cylinder_near_margin(double s) { return two(cube_of(s), {}, Cylinder{s, s}, at(0, s / 4, 1.875 * s)); }
Scene gap_near_margin(double gap) { return two(cube_of(1), {}, cube_of(1), at(0.25, 0.125, 2 + gap)); }

Scene depth_at_1000(double depth) {
  return two(cube_of(0.5), at(1000, 0, 0), cube_of(0.5), at(1001 - depth, 0.25, 0));
}
Scene sphere_depth_at_1000(double depth) {
  return two(Sphere{0.5}, at(1000, 0, 0), Sphere{0.5}, at(1001 - depth, 0, 0));
}

}  // namespace

std::vector<Ladder> size_ladders() {
  const std::vector<double> scales{1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1, 1e3, 1e5, 1e7};
  const std::vector<double> far{1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};
  const std::vector<double> ratios{2, 10, 100, 1e3, 1e4, 3e4, 1e5, 1e6};
  const std::vector<double> thin{0.125, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8};
  const std::vector<double> small{1, 0.25, 0.125, 0.08, 0.05, 0.04, 0.02, 0.01, 1e-3};
  return {
      {"skew-boxes-scaled", "absolute-tolerance", "overlapping boxes of size v", scales, skew_boxes_scaled},
      {"boxes-apart-scaled", "absolute-tolerance", "boxes of size v that are apart", scales,
       boxes_apart_scaled},
      {"sphere-box-scaled", "absolute-tolerance", "a sphere at an edge of a box, sizes v", scales,
       sphere_box_scaled},
      {"capsules-scaled", "absolute-tolerance", "overlapping capsules of size v", scales, capsules_scaled},
      {"cylinder-box-scaled",
       "absolute-tolerance",
       "a tilted cylinder in a box, sizes v",
       {1e-6, 1e-4, 1e-3, 1e-2, 1, 1e3},
       cylinder_box_scaled},
      {"skew-boxes-far", "far-from-origin", "overlapping boxes at distance v", far, skew_boxes_far},
      {"faces-far", "far-from-origin", "cubes a sixteenth deep at distance v", far, faces_far},
      {"gap-far", "far-from-origin", "a sphere a sixteenth above a cube at distance v", far, gap_far},
      {"cube-at-corner", "size-ratio", "a cube in the corner of one v times larger", ratios, cube_at_corner},
      {"sphere-on-large-box", "size-ratio", "a sphere in a box v times wider", ratios, sphere_on_large_box},
      {"cube-on-large-sphere", "size-ratio", "a cube in a sphere v times larger", ratios, large_sphere},
      {"crossed-rods",
       "slender",
       "rods of aspect ratio v at a right angle",
       {1, 10, 30, 100, 300, 1e3, 1e4, 1e6},
       rods_crossed},
      {"crossed-cylinders",
       "slender",
       "cylinders of aspect ratio v at a right angle",
       {1, 10, 30, 100, 1e3},
       rod_cylinders_crossed},
      {"long-capsule-over-box",
       "slender",
       "a capsule of half length v across a box",
       {1, 10, 100, 1e3, 1e4, 1e6},
       capsule_over_box},
      {"plates-overlapping", "thin-plate", "plates of half thickness v, half of it deep", thin,
       plates_overlapping},
      {"plates-crossed", "thin-plate", "plates of half thickness v that cut each other", thin,
       plates_crossed},
      {"disc-over-plate", "thin-plate", "a disc above a plate, half thicknesses and half gap v", thin,
       plate_under_disc},
      {"small-cubes-apart", "collision-margin", "cubes of half extent v, a quarter of it apart", small,
       near_margin},
      {"small-hull-over-cube", "collision-margin", "an octahedron above a cube, sizes v", small,
       hull_near_margin},
      {"small-cylinder-in-cube", "collision-margin", "a cylinder in a cube, sizes v", small,
       cylinder_near_margin},
      {"gap-like-a-margin",
       "collision-margin",
       "unit cubes with gap v",
       {1e-4, 1e-3, 5e-3, 0.01, 0.02, 0.04, 0.05, 0.08, 0.1},
       gap_near_margin},
      {"cubes-deep-at-1000",
       "rounding-depth",
       "cubes v deep a thousand units from the origin",
       {-1e-3, -1e-6, -1e-9, -1e-12, 0, 1e-12, 1e-9, 7e-8, 1e-6, 1e-3},
       depth_at_1000},
      {"spheres-deep-at-1000",
       "rounding-depth",
       "spheres v deep a thousand units from the origin",
       {-1e-3, -1e-6, -1e-9, -1e-12, 0, 1e-12, 1e-9, 7e-8, 1e-6, 1e-3},
       sphere_depth_at_1000},
  };
}

}  // namespace touchstone::scenarios
