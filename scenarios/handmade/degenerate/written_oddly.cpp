// The same sets written with unusual numbers: long, short and negated quaternions, -0, duplicate and interior
// vertices, normals of any length.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

// A quarter turn about z makes (1,2,3) reach 2 along x; the cube's face is at 3.5 - 1.
Scenario turned_box(const std::string& name, const std::string& line, const Quat& q) {
  return pair("degenerate", name, line, {Box{Vec3(1, 2, 3)}, at(0, 0, 0, q), {}},
              {Box{Vec3(1, 1, 1)}, at(3.5, 0, 0), {}},
              gap_is(0.5, 0, Vec3::UnitX(), "R(q) divides by |q|^2: 3.5 - 2 - 1"));
}

std::vector<Vec3> cube_corners(double h) {
  std::vector<Vec3> v;
  for (double i : {-h, h})
    for (double j : {-h, h})
      for (double k : {-h, h}) v.emplace_back(i, j, k);
  return v;
}

Scenario cube_hull(const std::string& name, const std::string& line, const std::vector<Vec3>& extra) {
  std::vector<Vec3> v = cube_corners(1);
  v.insert(v.end(), extra.begin(), extra.end());
  return pair("degenerate", name, line, {make_hull(std::move(v)), {}, {}},
              {Box{Vec3(1, 1, 1)}, at(0, 0, 2.25), {}},
              gap_is(0.25, 0, Vec3::UnitZ(), "the extra points lie in the cube: 2.25 - 1 - 1"));
}

std::vector<Vec3> edge_and_face_midpoints() {
  std::vector<Vec3> v;
  for (double i : {-1.0, 0.0, 1.0})
    for (double j : {-1.0, 0.0, 1.0})
      for (double k : {-1.0, 0.0, 1.0})
        if (i == 0 || j == 0 || k == 0) v.emplace_back(i, j, k);
  return v;
}

}  // namespace

List degenerate_written_oddly() {
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  const Box unit{Vec3(1, 1, 1)};
  return {
      turned_box("quaternion_of_length_4", "a quaternion that does not have unit length", {0, 0, 3, 3}),
      turned_box("quaternion_of_length_1e-160", "squares of its components underflow",
                 {0, 0, 1e-160, 1e-160}),
      turned_box("quaternion_of_length_1e160", "squares of its components overflow", {0, 0, 1e160, 1e160}),
      turned_box("quaternion_negated", "-q is the same rotation", {-0.0, 0, -1, -1}),
      pair("degenerate", "quaternion_typed_with_6_digits",
           "0.707107 twice: length 1 + 3e-7, still exactly 90 degrees",
           {Box{Vec3(1, 2, 3)}, at(0, 0, 0, Quat{0, 0, 0.707107, 0.707107}), {}}, {unit, at(3, 0, 0), {}},
           gap_is(0, 0, x, "equal components: a quarter turn whatever their size; 3 - 2 - 1")),
      pair("degenerate", "minus_zero_everywhere", "signed zeros in pose and touching faces",
           {unit, at(-0.0, -0.0, -0.0, Quat{-0.0, -0.0, -0.0, 1}), {}},
           {unit, at(2, -0.0, 0.0, Quat{0, -0.0, 0, -1}), {}}, gap_is(0, 0, x, "-0 = 0")),
      cube_hull("hull_with_every_vertex_thrice", "duplicate support points must not cycle",
                [] {
                  std::vector<Vec3> v = cube_corners(1);
                  const auto again = cube_corners(1);
                  v.insert(v.end(), again.begin(), again.end());
                  return v;
                }()),
      cube_hull("hull_with_midpoints", "collinear and coplanar vertices, and the centre",
                edge_and_face_midpoints()),
      cube_hull("hull_with_near_duplicates", "a second cube 2^-30 inside the first",
                cube_corners(1 - 0x1p-30)),
      pair("degenerate", "half_space_with_long_normal", "normal (1,2,2), offset 9: plane at distance 3",
           {HalfSpace{Vec3(1, 2, 2), 9}, {}, {}}, {Sphere{1}, at(2, 4, 4), {}},
           gap_is(2, 0, Vec3(1, 2, 2) / 3, "(18 - 9)/3 - 1")),
      pair("degenerate", "half_space_turned_and_shifted", "the plane moves with its body",
           // A quarter turn about x takes z to -y: the solid y >= -1 shifted by 4: y >= 3.
           {HalfSpace{Vec3(0, 0, 5), 5}, at(0, 4, 0, quarter_turn_x), {}}, {unit, at(0, 1.5, 0), {}},
           gap_is(0.5, 0, -Vec3::UnitY(), "the cube reaches y = 2.5, the solid begins at 3")),
      pair("degenerate", "box_sunk_in_half_space", "depth is measured along the plane's normal only",
           {HalfSpace{Vec3(0, 0, 5), 5}, {}, {}}, {Box{Vec3(0.5, 0.5, 0.5)}, at(7, 0, 1.25), {}},
           gap_is(-0.25, 0, z, "plane z = 1, lowest face at 0.75")),
  };
}

}  // namespace touchstone::scenarios
