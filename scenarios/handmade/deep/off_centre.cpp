// Overlaps whose direction of least depth does not point from centre to centre: portal refinement (MPR) and
// heuristic normals fail.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

// Prism |u| <= length, |v| + |z| <= 1, with u the x axis (or y) and v the other: ridges at z = ±1 along u.
Hull diamond_prism(double length, bool along_x) {
  std::vector<Vec3> v;
  for (double u : {-length, length})
    for (double s : {-1.0, 1.0}) {
      v.push_back(along_x ? Vec3(u, 0, s) : Vec3(0, u, s));
      v.push_back(along_x ? Vec3(u, s, 0) : Vec3(s, u, 0));
    }
  return make_hull(std::move(v));
}

}  // namespace

List deep_off_centre() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const Box beam{Vec3(10, 1, 1)}, unit{Vec3(1, 1, 1)}, half{Vec3(0.5, 0.5, 0.5)};
  const double l = 29.0 / 128;
  return {
      pair("deep", "beams_overlap_sideways",
           "the line of centres runs along the beams, the way out is sideways",
           {beam, {}, {}}, {beam, at(15, 2 - 0x1p-4, 0), {}}, gap_is(-0x1p-4, 0, y, "x 5, y 2^-4, z 2")),
      pair("deep", "cube_inside_box", "an immersed cube, nearest to one face", {Box{Vec3(4, 4, 4)}, {}, {}},
           {unit, at(2, 0.5, -1), {}}, gap_is(-3, 0, x, "x 5-2, y 5-0.5, z 5-1")),
      pair("deep", "nested_boxes_with_coplanar_faces", "the inner box shares two face planes with the outer",
           {unit, {}, {}}, {half, at(0.5, 0.5, 0), {}},
           gap_is(-1, 0, x, "1.5 - 0.5 along x or y, 1.5 along z")),
      pair("deep", "sphere_centre_on_face", "the closest-point direction vanishes", {unit, {}, {}},
           {Sphere{0.5}, at(1, 0, 0), {}}, gap_is(-0.5, 0, x, "the radius")),
      pair("deep", "sphere_centre_on_edge", "a quarter circle of directions ties", {unit, {}, {}},
           {Sphere{0.5}, at(1, 1, 0), {}}, gap_is(-0.5, 0, x, "the radius")),
      pair("deep", "sphere_centre_on_corner", "an octant of directions ties", {unit, {}, {}},
           {Sphere{0.5}, at(1, 1, 1), {}}, gap_is(-0.5, 0, x, "the radius")),
      pair("deep", "sphere_just_inside_face", "centre 2^-30 under the face", {unit, {}, {}},
           {Sphere{0.5}, at(1 - 0x1p-30, 0, 0), {}}, gap_is(-(0.5 + 0x1p-30), 0, x, "radius + 2^-30")),
      pair("deep", "sphere_inside_box", "fully immersed, off centre", {unit, {}, {}},
           {Sphere{0.25}, at(0.5, 0.25, 0), {}}, gap_is(-0.75, 0, x, "1 - 0.5 + 0.25")),
      pair("deep", "cylinders_rim_to_rim", "the rims overlap in a lens; the way out is along the axis",
           {Cylinder{1, 1}, {}, {}}, {Cylinder{1, 1}, at(1.25, 0, 2 - 0x1p-4), {}},
           // n = (sin a, 0, cos a): w = 2 sin a + 2 cos a - 1.25 sin a - (2 - 2^-4) cos a, least at a = 0.
           gap_is(-0x1p-4, 0, z, "axis 2^-4, across 0.75")),
      pair("deep", "post_through_plate", "a long box through a plate near the plate's rim",
           {Box{Vec3(4, 4, 0.125)}, {}, {}}, {Box{Vec3(0.25, 0.25, 4)}, at(3.5, 0, 1), {}},
           gap_is(-0.75, 0, x, "x 4.25-3.5, y 4.25, z 4.125-1")),
      pair("deep", "edges_beat_faces_by_3_percent",
           "a separating-axis test that favours faces by 5 % picks the face",
           {diamond_prism(l, true), {}, {}}, {diamond_prism(l, false), at(0, 0, 1.5), {}},
           // Edge cross edge is z: w = 1 + 1 - 1.5. A face normal (0,1,1)/sqrt2: h_A = 1, h_B = 1 + l, over
           // sqrt2, is (0.5 + l)/sqrt2 = 0.5138; the end faces 1 + l.
           gap_is(-0.5, 0, z, "edge-edge 0.5, best face (0.5 + 29/128)/sqrt 2 = 0.514")),
  };
}

}  // namespace touchstone::scenarios
