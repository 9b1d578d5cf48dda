// The same small distances far from the origin. Each offset is exact in double; float32 loses it before its
// algorithm starts, which the judgement "as received" must report.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

Hull cube_about(double x) {
  std::vector<Vec3> v;
  for (double i : {-1.0, 1.0})
    for (double j : {-1.0, 1.0})
      for (double k : {-1.0, 1.0}) v.emplace_back(x + i, j, k);
  return make_hull(std::move(v));
}

}  // namespace

List far_offsets() {
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  const Box unit{Vec3(1, 1, 1)};
  const double e6 = 1e6, p30 = 0x1p30, p40 = 0x1p40, p100 = 0x1p100;
  return {
      pair("far", "cubes_touch_at_1e6", "face contact a thousand kilometres out", {unit, at(e6, e6, e6), {}},
           {unit, at(e6 + 2, e6, e6), {}}, gap_is(0, 0, x, "whole numbers")),
      pair("far", "cubes_apart_at_2_40", "gap 2^-10 at 2^40", {unit, at(p40, p40, p40), {}},
           {unit, at(p40 + 2 + 0x1p-10, p40, p40), {}}, gap_is(0x1p-10, 0, x, "51 bits: exact")),
      pair("far", "spheres_overlap_at_2_30", "overlap 2^-20 at 2^30", {Sphere{1}, at(p30, -p30, p30), {}},
           {Sphere{1}, at(p30 + 2 - 0x1p-20, -p30, p30), {}}, gap_is(-0x1p-20, 0, x, "52 bits: exact")),
      pair("far", "hull_far_from_its_own_origin",
           "vertices at 2^20 in the body frame; the pose brings them back",
           {cube_about(0x1p20), at(-0x1p20, 0, 0), {}}, {unit, at(2.5, 0, 0), {}},
           gap_is(0.5, 0, x, "2.5 - 1 - 1")),
      pair("far", "hull_turned_about_a_far_origin", "a quarter turn swings vertices at 2^20 into place",
           // The turn about z takes (2^20, ·) to (·, 2^20).
           {cube_about(0x1p20), at(0, -0x1p20, 0, quarter_turn_z), {}}, {unit, at(2.5, 0, 0), {}},
           gap_is(0.5, 0, x, "2.5 - 1 - 1")),
      pair("far", "plane_far_away", "a ball above a half-space whose plane is at 2^30",
           {HalfSpace{Vec3(0, 0, 1), p30}, {}, {}}, {Sphere{1}, at(5, 0, p30 + 1 + 0x1p-10), {}},
           gap_is(0x1p-10, 0, z, "exact")),
      pair("far", "ends_of_the_world", "unit balls 2^101 apart", {Sphere{1}, at(-p100, 0, 0), {}},
           {Sphere{1}, at(p100, 0, 0), {}},
           gap_is(0x1p101, roundings(2, 0x1p101), x, "2^101 - 2, which is not a double")),
  };
}

}  // namespace touchstone::scenarios
