// Shapes with one or two extents far smaller than the others: depth filters, margins and feature tolerances
// exceed the thickness of the shape.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

constexpr double thin = 0x1p-20;

// Base of size s one unit above the tip, which is the origin.
Hull needle(double s) { return make_hull({{0, 0, 0}, {s, 0, 1}, {0, s, 1}, {-s, -s, 1}}); }

}  // namespace

List thin_plates_and_rods() {
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  const Box big_plate{Vec3(100, 100, 0x1p-13)}, plate{Vec3(1, 1, thin)}, unit{Vec3(1, 1, 1)};
  const Cylinder rod{0x1p-10, 1};
  return {
      pair("thin", "plates_stacked", "wide plates overlap by a quarter of their thickness",
           {big_plate, {}, {}}, {big_plate, at(0, 0, 0x1p-12 - 0x1p-14), {}},
           gap_is(-0x1p-14, 0, z, "2·2^-13 - offset")),
      pair("thin", "plate_in_sphere", "a plate through the middle of a ball", {Sphere{1}, {}, {}},
           {Box{Vec3(2, 2, thin)}, {}, {}},
           // w(n) = 1 + 2|nx| + 2|ny| + thin·|nz|, least along z.
           gap_is(-(1 + thin), 0, z, "1 + thickness/2 along z")),
      pair("thin", "plates_crossed", "two plates cut each other at a right angle through the middle",
           {plate, {}, {}}, {plate, at(0, 0, 0, quarter_turn_x), {}},
           // w = 2|nx| + (1 + thin)(|ny| + |nz|).
           gap_is(-(1 + thin), 0, z, "1 + thickness/2 along y or z")),
      pair("thin", "plates_edge_to_edge", "coplanar plates share a face 2^-19 high", {plate, {}, {}},
           {plate, at(2, 0, 0), {}}, gap_is(0, 0, x, "1 + 1 = 2")),
      pair("thin", "rods_crossed_overlapping",
           "rods of aspect ratio 1000 at a right angle, half a radius deep",
           {rod, {}, {}}, {rod, at(0x3p-11, 0, 0, quarter_turn_x), {}},
           gap_is(-0x1p-11, 0, x, "2·2^-10 - 1.5·2^-10")),
      pair("thin", "rods_crossed_apart", "rods of aspect ratio 1000 at a right angle, 2^-9 apart",
           {rod, {}, {}}, {rod, at(0x1p-8, 0, 0, quarter_turn_x), {}},
           gap_is(0x1p-9, 0, x, "2^-8 - 2·2^-10")),
      pair("thin", "long_rod_over_cube", "a capsule of aspect ratio 10^6 crosses above a cube",
           {unit, {}, {}}, {Capsule{1, 0x1p20}, at(1000, 0, 2.5, quarter_turn_y), {}}, gap_is(0.5, 0, z, "2.5 - 1 - 1")),
      pair("thin", "needle_in_box", "a needle of width 2^-30 pierces a face", {unit, at(0, 0, -1), {}},
           {needle(0x1p-30), at(0, 0, -0x1p-10), {}},
           // Up: 2^-10. Sideways at least 1.
           gap_is(-0x1p-10, 0, z, "tip 2^-10 below the face")),
      pair("thin", "needle_over_box", "a needle of width 2^-30 stops short of a face",
           {unit, at(0, 0, -1), {}}, {needle(0x1p-30), at(0.5, 0.25, 0x1p-10), {}},
           gap_is(0x1p-10, 0, z, "tip 2^-10 above the face")),
      pair("thin", "disc_beside_disc", "thin discs in one plane, rim to rim", {Cylinder{1, thin}, {}, {}},
           {Cylinder{1, thin}, at(2.5, 0, 0), {}}, gap_is(0.5, 0, x, "2.5 - 1 - 1")),
  };
}

}  // namespace touchstone::scenarios
