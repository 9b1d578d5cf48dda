// Ties, containment, hulls with degenerate faces, shapes without volume, quaternions of any length.
#include "scenarios/handmade/ladders/parts.h"

namespace touchstone::scenarios {
namespace {

Scene corner_in_corner(double x) { return two(cube_of(10), {}, cube_of(5), at(14 + x, 14, 14)); }
Scene cube_in_cube(double x) { return two(cube_of(1), {}, cube_of(0.5), at(x, 0, 0)); }
Scene cube_in_cube_turned(double a) { return two(cube_of(1), {}, cube_of(0.5), at(0, 0, 0, about_z(a))); }
Scene beams_sideways(double x) { return two(Box{Vec3(8, 1, 1)}, {}, Box{Vec3(8, 1, 1)}, at(x, 0.875, 1.75)); }
Scene plate_over_post(double x) {
  return two(Box{Vec3(4, 4, 0.125)}, {}, Box{Vec3(0.25, 0.25, 2)}, at(x, 0.5, 1.5));
}
Scene cylinder_off_centre(double x) { return two(Cylinder{2, 0.25}, {}, Cylinder{2, 0.25}, at(x, 0, 0.375)); }
Scene box_inside_box(double x) {
  return two(Box{Vec3(2, 3, 4)}, {}, Box{Vec3(0.25, 0.5, 0.75)}, at(1.5 - x, 0.25, 0.125));
}
Scene capsule_inside_box(double x) {
  return two(Box{Vec3(2, 3, 4)}, {}, Capsule{0.25, 0.5}, at(1.5 - x, 0.25, 0.125, quarter_turn_x));
}
Scene nested_with_common_planes(double x) {
  return two(Box{Vec3(1, 1, 1)}, {}, Box{Vec3(1, 0.5, 1)}, at(0, x, 0));
}
Scene towers(double x) { return two(Box{Vec3(0.5, 0.5, 2)}, {}, Box{Vec3(0.5, 0.5, 2)}, at(0.9375, x, 0)); }

/// A unit cube whose upper corners are there twice, the second time moved out by x.
Hull doubled_cube(double x) {
  return make_hull({{1, 1, 1},
                    {-1, 1, 1},
                    {1, -1, 1},
                    {-1, -1, 1},
                    {1, 1, -1},
                    {-1, 1, -1},
                    {1, -1, -1},
                    {-1, -1, -1},
                    {1 + x, 1, 1},
                    {-1 - x, 1, 1},
                    {1 + x, -1, 1},
                    {-1 - x, -1, 1}});
}
Scene doubled_over_cube(double x) { return two(cube_of(1), {}, doubled_cube(x), at(0.25, 0.125, 1.9375)); }
Scene doubled_apart(double x) {
  return two(cube_of(1), {}, doubled_cube(x), at(2.25, 0.125, 0.5, about_z(0.25)));
}

/// A prism whose cap is coplanar up to x.
Hull noisy_prism(double x) {
  return make_hull({{1, 0, 1 + x},
                    {0.5, 0.875, 1 - x},
                    {-0.5, 0.875, 1 + x},
                    {-1, 0, 1 - x},
                    {-0.5, -0.875, 1 + x},
                    {0.5, -0.875, 1 - x},
                    {1, 0, -1},
                    {0.5, 0.875, -1},
                    {-0.5, 0.875, -1},
                    {-1, 0, -1},
                    {-0.5, -0.875, -1},
                    {0.5, -0.875, -1}});
}
Scene noisy_cap_in_cube(double x) { return two(noisy_prism(x), {}, cube_of(0.5), at(0.125, 0.25, 1.4375)); }
Scene noisy_caps(double x) { return two(noisy_prism(x), {}, noisy_prism(-x), at(0.125, 0.25, 1.9375)); }

/// A tetrahedron of width x.
Hull needle(double x) { return make_hull({{0, 0, -2}, {x, 0, 2}, {-x, x, 2}, {-x, -x, 2}}); }
Scene needle_in_face(double x) { return two(cube_of(1), {}, needle(x), at(0.25, 0.125, 2.9375)); }
Scene needle_beside_face(double x) { return two(cube_of(1), {}, needle(x), at(1.125, 0.125, 0.25)); }

Hull square(double z) { return make_hull({{1, 1, z}, {-1, 1, z}, {1, -1, z}, {-1, -1, z}}); }
Scene square_over_cube(double gap) { return two(cube_of(0.5), {}, square(0), at(0.25, 0.125, 0.5 + gap)); }
Scene squares_crossed(double x) { return two(square(0), {}, square(0), at(0.25, 0.125, x, quarter_turn_x)); }
Scene triangles_meeting(double gap) {
  return two(make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), {}, make_hull({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}}),
             at(0.25, 0.25, gap));
}

Scene sphere_on_point(double d) { return two(Sphere{0}, {}, Sphere{0.5}, at(d, 0, 0)); }
Scene box_over_segment(double d) { return two(Box{Vec3(1, 0, 0)}, {}, cube_of(0.5), at(0.25, 0, 0.5 + d)); }
Scene box_over_rectangle(double d) { return two(Box{Vec3(1, 1, 0)}, {}, cube_of(0.5), at(0.25, 0, 0.5 + d)); }
Scene points_apart(double d) { return two(Box{Vec3::Zero()}, at(1, 0, 0), Sphere{0}, at(1, d, 0)); }

Quat scaled(const Quat& q, double s) { return {q.x * s, q.y * s, q.z * s, q.w * s}; }
Scene quaternion_of_length(double s) {
  return two(Box{Vec3(1, 0.75, 0.5)}, at(0, 0, 0, scaled(skew_turn, s)), Box{Vec3(0.5, 1, 0.625)},
             at(0.875, 0.75, 1.125, scaled(other_turn, s)));
}
Scene quaternion_of_length_apart(double s) {
  return two(Box{Vec3(1, 0.75, 0.5)}, at(0, 0, 0, scaled(skew_turn, s)), Capsule{0.25, 1},
             at(1.5, 0.75, 1.125, scaled(other_turn, s)));
}

}  // namespace

std::vector<Ladder> degenerate_ladders() {
  const std::vector<double> offsets{0, 1e-16, 1e-12, 1e-9, 1e-6, 1e-3, 0.125};
  const std::vector<double> widths{0.5, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  const std::vector<double> noise{0, 1e-16, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2};
  const std::vector<double> gaps{-0.125, -1e-6, -1e-12, 0, 1e-12, 1e-6, 0.125};
  const std::vector<double> distances{0, 1e-300, 1e-12, 1e-6, 0.125, 0.5, 1};
  const std::vector<double> lengths{1e-12, 1e-6, 1e-3, 0.5, 0.999999, 1.000001, 2, 1e3, 1e6, 1e12};
  return {
      {"corner-in-corner", "tied-directions", "a cube in a corner of another, three ways out, v off", offsets,
       corner_in_corner},
      {"cube-in-cube", "tied-directions", "a cube in the middle of another, v off", offsets, cube_in_cube},
      {"cube-in-cube-turned", "tied-directions", "a cube in the middle of another, turned by v", offsets,
       cube_in_cube_turned},
      {"beams-sideways",
       "off-centre",
       "beams side by side, shifted along themselves by v",
       {0, 0.5, 2, 8, 12, 15},
       beams_sideways},
      {"post-through-plate",
       "off-centre",
       "a post through a plate, v from its middle",
       {0, 1, 2, 3, 3.5, 4, 4.125},
       plate_over_post},
      {"discs-off-centre",
       "off-centre",
       "discs an eighth deep, shifted by v",
       {0, 0.5, 1, 2, 3, 3.75},
       cylinder_off_centre},
      {"box-inside-box",
       "containment",
       "a box inside another, v further in",
       {0, 1e-9, 1e-3, 0.25, 0.5, 1, 1.5},
       box_inside_box},
      {"capsule-inside-box",
       "containment",
       "a capsule inside a box, v further in",
       {0, 1e-9, 1e-3, 0.25, 0.5, 1, 1.5},
       capsule_inside_box},
      {"nested-with-common-planes", "coplanar-faces", "a box in another with four common planes, v off",
       offsets, nested_with_common_planes},
      {"towers", "coplanar-faces", "towers side by side a sixteenth deep, shifted by v", offsets, towers},
      {"doubled-vertices", "duplicate-vertices", "vertices there twice, v apart: overlap", noise,
       doubled_over_cube},
      {"doubled-vertices-apart", "duplicate-vertices", "vertices there twice, v apart: gap", noise,
       doubled_apart},
      {"noisy-cap", "noisy-faces", "a cube in a cap that is flat up to v", noise, noisy_cap_in_cube},
      {"noisy-caps", "noisy-faces", "two caps that are flat up to v", noise, noisy_caps},
      {"needle-in-face", "needle-face", "a needle of width v pierces a face", widths, needle_in_face},
      {"needle-beside-face", "needle-face", "a needle of width v beside a face", widths, needle_beside_face},
      {"square-over-cube", "flat-shape", "a square above a cube with gap v", gaps, square_over_cube},
      {"squares-crossed",
       "flat-shape",
       "squares at a right angle, shifted by v",
       {0, 1e-9, 0.5, 1, 1.25},
       squares_crossed},
      {"triangles-meeting", "flat-shape", "the corner of a triangle above another with gap v", gaps,
       triangles_meeting},
      {"sphere-over-point", "zero-size", "a point v from the centre of a sphere", distances, sphere_on_point},
      {"segment-in-cube", "zero-size", "a segment v below the face of a cube", gaps, box_over_segment},
      {"rectangle-in-cube", "zero-size", "a rectangle v below the face of a cube", gaps, box_over_rectangle},
      {"points", "zero-size", "two points v apart", distances, points_apart},
      {"quaternions-overlap", "quaternion-length", "boxes that overlap, quaternions v times as long", lengths,
       quaternion_of_length},
      {"quaternions-apart", "quaternion-length", "bodies that are apart, quaternions v times as long",
       lengths, quaternion_of_length_apart},
  };
}

}  // namespace touchstone::scenarios
