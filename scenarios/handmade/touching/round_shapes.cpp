// Round shapes that touch exactly; Pythagorean triples keep every distance a whole number.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {

List touching_round_shapes() {
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  const Box unit{Vec3(1, 1, 1)};
  const Capsule capsule{0.5, 1};
  const HalfSpace ground{Vec3(0, 0, 1), 0};
  return {
      pair("touching", "spheres_kiss", "unit spheres, centres 2 apart", {Sphere{1}, {}, {}},
           {Sphere{1}, at(2, 0, 0), {}}, gap_is(0, 0, x, "2 - 1 - 1")),
      pair("touching", "spheres_kiss_off_axis", "the touching direction is not an axis",
           {Sphere{1.5}, {}, {}}, {Sphere{5.5}, at(2, 3, 6), {}},
           gap_is(0, 0, Vec3(2, 3, 6) / 7, "|(2,3,6)| = 7 = 1.5 + 5.5")),
      pair("touching", "spheres_one_ulp_apart", "the smallest gap that a double offset can make",
           {Sphere{1}, {}, {}}, {Sphere{1}, at(2 + 0x1p-51, 0, 0), {}}, gap_is(0x1p-51, 0, x, "exact")),
      pair("touching", "spheres_one_ulp_inside", "the smallest overlap that a double offset can make",
           {Sphere{1}, {}, {}}, {Sphere{1}, at(2 - 0x1p-52, 0, 0), {}}, gap_is(-0x1p-52, 0, x, "exact")),
      pair("touching", "sphere_on_box_face", "a ball lies on a box", {unit, {}, {}},
           {Sphere{2}, at(0.5, 0, 3), {}}, gap_is(0, 0, z, "3 - 1 - 2")),
      pair("touching", "sphere_on_box_edge", "a ball touches an edge", {unit, {}, {}},
           {Sphere{5}, at(4, 5, 0), {}},
           gap_is(0, 0, Vec3(0.6, 0.8, 0), "|(3,4,0)| = 5 from the edge x = y = 1")),
      pair("touching", "sphere_on_box_corner", "a ball touches a corner", {unit, {}, {}},
           {Sphere{7}, at(3, 4, 7), {}},
           gap_is(0, 0, Vec3(2, 3, 6) / 7, "|(2,3,6)| = 7 from the corner (1,1,1)")),
      pair("touching", "capsules_side_by_side", "parallel capsules touch along a segment", {capsule, {}, {}},
           {capsule, at(1, 0, 0.25), {}}, gap_is(0, 0, x, "axes 1 apart, radii 0.5")),
      pair("touching", "capsules_crossed", "capsules at a right angle touch at a point", {capsule, {}, {}},
           {capsule, at(1, 0, 0, quarter_turn_x), {}}, gap_is(0, 0, x, "axes 1 apart, radii 0.5")),
      pair("touching", "capsule_end_on_box", "a capsule stands on a box", {unit, {}, {}},
           {capsule, at(0, 0, 2.5), {}}, gap_is(0, 0, z, "2.5 - 1.5 - 1")),
      pair("touching", "cylinder_on_box", "a cylinder stands on a box, disc on face", {unit, {}, {}},
           {Cylinder{0.5, 1}, at(0.25, 0, 2), {}}, gap_is(0, 0, z, "2 - 1 - 1")),
      pair("touching", "cylinder_lies_on_box", "a cylinder lies on a box along a segment", {unit, {}, {}},
           {Cylinder{0.5, 1}, at(0, 0, 1.5, quarter_turn_x), {}}, gap_is(0, 0, z, "1.5 - 1 - 0.5")),
      pair("touching", "cylinders_end_to_end", "coaxial discs coincide", {Cylinder{1, 1}, {}, {}},
           {Cylinder{1, 1}, at(0, 0, 2), {}}, gap_is(0, 0, z, "1 + 1 = 2")),
      pair("touching", "cone_tip_on_box", "a cone balances on its tip", {unit, {}, {}},
           {Cone{0.5, 1}, at(0, 0, 2, half_turn_x), {}}, gap_is(0, 0, z, "tip at 2 - 1, face at 1")),
      pair("touching", "cone_tip_to_tip", "two tips meet", {Cone{0.5, 1}, {}, {}},
           {Cone{0.5, 1}, at(0, 0, 2, half_turn_x), {}}, gap_is(0, 0, z, "tips at 1 and 2 - 1")),
      pair("touching", "cone_base_on_ground", "a cone stands on a half-space", {ground, {}, {}},
           {Cone{2, 0.5}, at(3, 0, 0.5), {}}, gap_is(0, 0, z, "base at 0.5 - 0.5")),
      pair("touching", "ellipsoid_on_ground", "an ellipsoid lies on a half-space", {ground, {}, {}},
           {Ellipsoid{Vec3(3, 2, 1)}, at(0, 0, 1), {}}, gap_is(0, 0, z, "semi-axis 1 along z")),
      pair("touching", "ellipsoids_tip_to_tip", "two long ellipsoids touch at their sharp ends",
           {Ellipsoid{Vec3(8, 0.5, 0.5)}, {}, {}}, {Ellipsoid{Vec3(4, 1, 1)}, at(12, 0, 0), {}},
           gap_is(0, 0, x, "8 + 4 = 12 along the common axis")),
      pair("touching", "rounded_boxes_face_to_face", "flat faces, half covering each other",
           {RoundedBox{Vec3(1, 1, 1), 0.5}, {}, {}}, {RoundedBox{Vec3(2, 1, 1), 0.25}, at(3.75, 1, 0), {}},
           gap_is(0, 0, x, "1 + 0.5 + 0.25 + 2")),
      pair("touching", "rounded_boxes_edge_to_edge", "parallel round edges touch along a segment",
           {RoundedBox{Vec3(1, 1, 1), 2}, {}, {}}, {RoundedBox{Vec3(1, 1, 2), 3}, at(5, 6, 0.5), {}},
           gap_is(0, 0, Vec3(0.6, 0.8, 0), "|(3,4)| = 2 + 3 between the edges of the cores")),
      pair("touching", "sphere_on_rounded_corner", "a ball touches a round corner",
           {RoundedBox{Vec3(1, 1, 1), 2}, {}, {}}, {Sphere{5}, at(3, 4, 7), {}},
           gap_is(0, 0, Vec3(2, 3, 6) / 7, "|(2,3,6)| = 7 = 2 + 5 from the core's corner")),
      pair("touching", "rounded_boxes_thin_radius", "a radius of 2^-40 decides",
           {RoundedBox{Vec3(1, 1, 1), 0x1p-40}, {}, {}},
           {RoundedBox{Vec3(1, 1, 1), 0}, at(2 + 0x1p-40, 0.5, 0), {}}, gap_is(0, 0, x, "1 + 2^-40 + 1")),
  };
}

}  // namespace touchstone::scenarios
