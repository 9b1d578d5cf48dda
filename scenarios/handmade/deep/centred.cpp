// Concentric and coaxial bodies: many directions tie for the least depth, and GJK starts at the origin
// itself.
#include <cmath>

#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {

List deep_centred() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const Capsule capsule{0.25, 1};
  const Cylinder disc{1, 0.25};
  const Box unit{Vec3(1, 1, 1)};
  return {
      pair("deep", "concentric_spheres", "every direction has the least depth", {Sphere{1}, at(1, 2, 3), {}},
           {Sphere{3}, at(1, 2, 3), {}}, gap_is(-4, 0, x, "1 + 3")),
      pair("deep", "nearly_concentric_spheres", "centres 2^-40 apart decide the normal", {Sphere{1}, {}, {}},
           {Sphere{3}, at(0, 0x1p-40, 0), {}}, gap_is(-(4 - 0x1p-40), 0, y, "1 + 3 - 2^-40")),
      pair("deep", "cube_in_cube", "six directions tie", {Box{Vec3(2, 2, 2)}, {}, {}}, {unit, {}, {}},
           gap_is(-3, 0, x, "2 + 1")),
      pair("deep", "same_cube_twice", "a body and its copy", {unit, at(0.5, 0, 0), {}},
           {unit, at(0.5, 0, 0), {}}, gap_is(-2, 0, x, "1 + 1")),
      pair("deep", "coaxial_discs", "two flat cylinders at the same place", {disc, {}, {}}, {disc, {}, {}},
           gap_is(-0.5, 0, z, "0.25 + 0.25 along the axis, 2 across")),
      pair("deep", "coaxial_capsules", "core segments coincide", {capsule, {}, {}}, {capsule, {}, {}},
           gap_is(-0.5, 0, x, "radii, across the axis")),
      pair("deep", "capsules_crossed_through_the_middle", "core segments intersect in a point",
           {capsule, {}, {}}, {capsule, at(0, 0, 0, quarter_turn_x), {}},
           gap_is(-0.5, 0, x, "radii, along the common normal")),
      pair("deep", "rounded_box_in_rounded_box", "concentric: the shortest extents and both radii",
           {RoundedBox{Vec3(2, 3, 4), 0.5}, at(1, 2, 3), {}},
           {RoundedBox{Vec3(1, 1, 1), 0.25}, at(1, 2, 3), {}}, gap_is(-3.75, 0, x, "2 + 0.5 + 0.25 + 1")),
      pair("deep", "ellipsoid_in_sphere", "the short axis is the way out", {Ellipsoid{Vec3(1, 2, 3)}, {}, {}},
           {Sphere{0.5}, {}, {}}, gap_is(-1.5, 0, x, "w(n) = |diag(1,2,3) n| + 0.5, least along x")),
      pair("deep", "cylinder_in_box", "coaxial, equal heights: the axis is not the shortest way out",
           {unit, {}, {}}, {Cylinder{0.5, 1}, {}, {}}, gap_is(-1.5, 0, x, "1 + 0.5 across, 2 along")),
      pair("deep", "cone_in_cylinder",
           "coaxial; the way out is sideways and slightly down, perpendicular to the cone's side",
           {Cylinder{1, 4}, {}, {}}, {Cone{0.5, 4}, {}, {}},
           // n = (cos a, 0, -sin a): the cylinder gives cos a + 4 sin a, the cone 0.5 cos a - 4 sin a while
           // its rim leads, together 1.5 cos a; from tan a = 1/16 on its tip leads and w grows again.
           gap_is(-24 / std::sqrt(257.0), roundings(4, 4), Vec3(16, 0, -1) / std::sqrt(257.0),
                  "1.5 cos a with tan a = 1/16")),
  };
}

}  // namespace touchstone::scenarios
