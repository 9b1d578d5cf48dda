// Round shapes: centres that coincide or lie on a surface, rims, caps, tips.
#include "scenarios/handmade/ladders/parts.h"

namespace touchstone::scenarios {
namespace {

Scene spheres_at_offset(double x) { return two(Sphere{1}, {}, Sphere{0.5}, at(x, 0, 0)); }
Scene equal_spheres_at_offset(double x) { return two(Sphere{1}, {}, Sphere{1}, at(x, x, 0)); }
Scene capsules_at_offset(double x) { return two(Capsule{0.5, 1}, {}, Capsule{0.5, 1}, at(x, 0, 0)); }
Scene capsules_crossed_at_offset(double z) {
  return two(Capsule{0.5, 1}, {}, Capsule{0.25, 1}, at(0, z, 0, quarter_turn_x));
}
Scene sphere_in_capsule(double x) { return two(Capsule{0.5, 1}, {}, Sphere{0.25}, at(x, 0, 0.5)); }

Scene sphere_above_face(double z) { return two(cube_of(1), {}, Sphere{0.5}, at(0.25, 0.125, 1 + z)); }
Scene sphere_beyond_edge(double z) { return two(cube_of(1), {}, Sphere{0.5}, at(1 + z, 0.125, 1 + z)); }
Scene sphere_beyond_corner(double z) { return two(cube_of(1), {}, Sphere{0.5}, at(1 + z, 1 + z, 1 + z)); }
Scene sphere_near_cylinder_side(double x) { return two(Cylinder{1, 2}, {}, Sphere{0.5}, at(1 + x, 0, 0.5)); }
Scene sphere_near_rim(double x) { return two(Cylinder{1, 2}, {}, Sphere{0.5}, at(1 + x, 0, 2 + x)); }
Scene capsule_core_on_face(double z) {
  return two(cube_of(1), {}, Capsule{0.5, 0.75}, at(0, 0, 1 + z, quarter_turn_x));
}
Scene sphere_inside_box(double z) {
  return two(Box{Vec3(1, 1.25, 1.5)}, {}, Sphere{0.25}, at(0.5, 0.125, 1.5 - z));
}
Scene sphere_inside_hull(double z) {
  return two(make_hull({{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}}), {},
             Sphere{0.25}, at(0.125, 0.0625, z));
}

Scene sphere_on_face(double gap) { return two(cube_of(1), {}, Sphere{0.5}, at(0.25, 0.125, 1.5 + gap)); }
Scene sphere_on_edge(double gap) { return two(cube_of(1), {}, Sphere{1.25}, at(1.75 + gap, 0.125, 2)); }
Scene capsule_on_face(double gap) {
  return two(cube_of(1), {}, Capsule{0.25, 0.5}, at(0, 0.125, 1.25 + gap, quarter_turn_x));
}
Scene cylinder_on_face(double gap) {
  return two(cube_of(1), {}, Cylinder{0.5, 0.75}, at(0, 0.25, 1.75 + gap));
}
Scene cylinder_lying_on_face(double gap) {
  return two(cube_of(1), {}, Cylinder{0.5, 0.75}, at(0.125, 0, 1.5 + gap, quarter_turn_x));
}
Scene spheres_touching(double gap) { return two(Sphere{1}, {}, Sphere{1.5}, at(1.5, 0, 2 + gap)); }
Scene sphere_on_capsule_end(double gap) {
  return two(Capsule{0.5, 1}, {}, Sphere{0.75}, at(0, 0.75, 2 + gap));
}
Scene capsules_parallel(double gap) {
  return two(Capsule{0.5, 1}, {}, Capsule{0.25, 1}, at(0.75 + gap, 0, 0.5));
}
Scene cylinders_parallel(double gap) {
  return two(Cylinder{0.5, 1}, {}, Cylinder{0.25, 1}, at(0.75 + gap, 0, 0.5));
}

Scene cap_tilted(double a) {
  return two(Box{Vec3(1, 1, 0.5)}, {}, Cylinder{0.5, 0.75}, at(0.125, 0, 1.1875, about_y(a)));
}
Scene side_tilted(double a) {
  return two(Box{Vec3(1, 1, 0.5)}, {}, Cylinder{0.5, 0.75},
             at(0.125, 0, 0.9375, about_x(2 * std::atan(1.0) + a)));
}
Scene discs_shifted(double x) { return two(Cylinder{1, 0.125}, {}, Cylinder{1, 0.125}, at(x, 0, 0)); }
Scene rims_crossing(double x) { return two(Cylinder{1, 0.5}, {}, Cylinder{1, 0.5}, at(2 - x, 0, 0.875)); }

Scene cone_on_face(double gap) {
  return two(cube_of(1), {}, Cone{0.5, 1}, at(0.25, 0.125, 2 + gap, half_turn_x));
}
Scene cone_on_cone(double gap) { return two(Cone{0.5, 1}, {}, Cone{0.5, 1}, at(0, 0, 2 + gap, half_turn_x)); }
Scene ellipsoid_on_face(double length) {
  return two(cube_of(1), {}, Ellipsoid{Vec3(0.25, 0.25, length)}, at(0.25, 0.125, 1 + 0.9375 * length));
}
Scene rounded_boxes(double radius) {
  return two(RoundedBox{Vec3(1, 1, 1), radius}, {}, RoundedBox{Vec3(0.5, 0.5, 0.5), radius},
             at(1.5, 1.5, 1.5 + radius));
}
Scene rounded_boxes_deep(double radius) {
  return two(RoundedBox{Vec3(1, 1, 1), radius}, {}, RoundedBox{Vec3(0.5, 0.5, 0.5), radius},
             at(0.25, 0.125, 1.25));
}

}  // namespace

std::vector<Ladder> round_ladders() {
  const std::vector<double> offsets{0, 1e-300, 1e-16, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 0.125};
  const std::vector<double> sides{-0.125, -1e-3, -1e-5, -1e-7, -1e-12, 0, 1e-12, 1e-7, 1e-5, 1e-3, 0.125};
  const std::vector<double> gaps{-0.0625, -1e-3, -1e-6, -1e-9, -1e-12, 0, 1e-12, 1e-9, 1e-6, 1e-3, 0.0625};
  const std::vector<double> few{-0.0625, -1e-3, -1e-9, 0, 1e-9, 1e-3, 0.0625};
  const std::vector<double> angles{0, 1e-16, 1e-12, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2};
  const std::vector<double> radii{1, 0.125, 1e-2, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0};
  return {
      {"spheres-offset", "coincident-centres", "a sphere in a larger one, centres v apart", offsets,
       spheres_at_offset},
      {"equal-spheres-offset", "coincident-centres", "equal spheres, centres apart by v along two axes",
       offsets, equal_spheres_at_offset},
      {"parallel-capsules-offset", "coincident-centres", "equal parallel capsules, axes v apart", offsets,
       capsules_at_offset},
      {"crossed-capsules-offset", "coincident-centres", "capsules at a right angle, axes v apart", offsets,
       capsules_crossed_at_offset},
      {"sphere-in-capsule", "coincident-centres", "a sphere in a capsule, v from its axis", offsets,
       sphere_in_capsule},
      {"sphere-centre-at-face", "centre-on-surface", "the centre of a sphere v above a face", sides,
       sphere_above_face},
      {"sphere-centre-at-edge", "centre-on-surface", "the centre of a sphere v beyond an edge, on both axes",
       sides, sphere_beyond_edge},
      {"sphere-centre-at-corner", "centre-on-surface",
       "the centre of a sphere v beyond a corner, on each axis", sides, sphere_beyond_corner},
      {"sphere-centre-at-cylinder", "centre-on-surface", "the centre of a sphere v outside a cylinder's side",
       sides, sphere_near_cylinder_side},
      {"sphere-centre-at-rim", "centre-on-surface", "the centre of a sphere v beyond a cylinder's rim", sides,
       sphere_near_rim},
      {"capsule-axis-at-face", "centre-on-surface", "the axis of a capsule v above a face", sides,
       capsule_core_on_face},
      {"sphere-inside-box",
       "centre-inside",
       "the centre of a sphere v below a face",
       {1e-6, 1e-3, 0.125, 0.25, 0.5, 0.75, 1, 1.5},
       sphere_inside_box},
      {"sphere-inside-octahedron",
       "centre-inside",
       "a sphere v above the middle of an octahedron",
       {0, 1e-9, 1e-3, 0.25, 0.5, 1, 1.5},
       sphere_inside_hull},
      {"sphere-on-face-at-gap", "round-on-flat", "a sphere over a face with gap v", gaps, sphere_on_face},
      {"sphere-on-edge-at-gap", "round-on-flat", "a sphere beside an edge, moved out by v", gaps,
       sphere_on_edge},
      {"capsule-on-face-at-gap", "round-on-flat", "a capsule lying over a face with gap v", gaps,
       capsule_on_face},
      {"cylinder-on-face-at-gap", "round-on-flat", "a cylinder standing over a face with gap v", few,
       cylinder_on_face},
      {"lying-cylinder-at-gap", "round-on-flat", "a cylinder lying over a face with gap v", few,
       cylinder_lying_on_face},
      {"spheres-at-gap", "round-on-round", "spheres moved apart from touching by v", gaps, spheres_touching},
      {"sphere-on-capsule-end", "round-on-round", "a sphere beside the end of a capsule, moved by v", gaps,
       sphere_on_capsule_end},
      {"parallel-capsules-at-gap", "round-on-round", "parallel capsules with gap v", gaps, capsules_parallel},
      {"parallel-cylinders-at-gap", "round-on-round", "parallel cylinders with gap v", few,
       cylinders_parallel},
      {"cap-tilted", "parallel-cap", "a cylinder in a face, its cap tilted by v", angles, cap_tilted},
      {"side-tilted", "parallel-cap", "a cylinder lying in a face, tilted by v", angles, side_tilted},
      {"coaxial-discs-shifted",
       "coaxial-rims",
       "equal discs, axes v apart",
       {0, 1e-12, 1e-6, 1e-3, 0.25, 1},
       discs_shifted},
      {"rims-crossing",
       "coaxial-rims",
       "rims that overlap sideways by v",
       {1e-6, 1e-3, 0.125, 0.5, 1},
       rims_crossing},
      {"cone-tip-on-face", "sharp-tip", "a cone on its tip with gap v", few, cone_on_face},
      {"cone-tips", "sharp-tip", "cones tip to tip with gap v", few, cone_on_cone},
      {"slender-ellipsoid",
       "iteration-limit",
       "the end of an ellipsoid of half length v in a face",
       {0.5, 1, 2, 5, 10, 20, 50},
       ellipsoid_on_face},
      {"rounded-corners", "rounded-edge", "boxes of radius v near to each other's corners", radii,
       rounded_boxes},
      {"rounded-boxes-deep", "rounded-edge", "boxes of radius v, one face in the other", radii,
       rounded_boxes_deep},
  };
}

}  // namespace touchstone::scenarios
