// Very large sizes, very small sizes, and both at once: these reveal absolute tolerances inside an engine.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

Box cube_of(double h) { return {Vec3(h, h, h)}; }

// Cubes of half extent h, `gap_in_h`·h apart along x.
Scenario cubes_of_size(const std::string& name, double h, double gap_in_h) {
  return pair("far", name, "equal cubes of half extent 2^" + std::to_string(std::ilogb(h)),
              {cube_of(h), {}, {}}, {cube_of(h), at((2 + gap_in_h) * h, 0, 0), {}},
              gap_is(gap_in_h * h, 0, Vec3::UnitX(), "scaled by a power of two: exact"));
}

}  // namespace

List far_size_ratios() {
  const Vec3 z = Vec3::UnitZ();
  const double big = 0x1p24, mm = 0x1p-10, um = 0x1p-20;
  return {
      pair("far", "pebble_on_planet", "radii 1 and 2^24 touch", {Sphere{big}, {}, {}},
           {Sphere{1}, at(0, 0, big + 1), {}},
           gap_is(0, 0, z, "2^24 + 1 is exact in double, not in float32")),
      pair("far", "cube_on_huge_box", "half extents 1 and 2^24 touch", {cube_of(big), {}, {}},
           {cube_of(1), at(3, 5, big + 1), {}},
           gap_is(0, 0, z, "2^24 + 1 is exact in double, not in float32")),
      pair("far", "small_cube_at_corner_of_large", "size ratio 10^4, overlap near a corner of the large cube",
           {cube_of(10000), {}, {}}, {cube_of(1), at(10000.5, 10000.5, 10001 - 0x1p-7), {}},
           gap_is(-0x1p-7, 0, z, "x and y are 0.5 deep, z 2^-7")),
      pair("far", "small_ball_on_edge_of_large", "size ratio 10^4, touching an edge of the large box",
           {cube_of(10000), {}, {}}, {Sphere{5}, at(10003, 10004, 77), {}},
           gap_is(0, 0, Vec3(0.6, 0.8, 0), "3-4-5 from the edge")),
      cubes_of_size("millimetre_cubes_overlap", mm, -0.125),
      cubes_of_size("millimetre_cubes_apart", mm, 0.125),
      cubes_of_size("micrometre_cubes_overlap", um, -0.125),
      cubes_of_size("nanometre_cubes_apart", 0x1p-30, 0.125),
      cubes_of_size("cubes_of_2_to_the_minus_80", 0x1p-80, -0.25),
      cubes_of_size("cubes_of_2_to_the_80", 0x1p80, 0.25),
      pair("far", "micrometre_cylinder_in_box", "a tiny cylinder sunk an eighth into a tiny box",
           {cube_of(um), {}, {}}, {Cylinder{um, um}, at(0, 0, 2 * um - um / 8), {}},
           gap_is(-um / 8, 0, z, "an eighth of the half extent")),
      pair("far", "millimetre_capsules", "tiny crossed capsules half a radius apart",
           {Capsule{mm, 4 * mm}, {}, {}}, {Capsule{mm, 4 * mm}, at(2.5 * mm, 0, 0, quarter_turn_x), {}},
           gap_is(0.5 * mm, 0, Vec3::UnitX(), "axes 2.5 radii apart")),
  };
}

}  // namespace touchstone::scenarios
