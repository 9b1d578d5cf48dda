// Equal boxes, aligned exactly or almost: the origin lies on features of every simplex, and cross products of
// nearly parallel edges are noise.
#include <cmath>

#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

const Box cube{Vec3(0.5, 0.5, 0.5)};

// q = (0, 0, t, 1) turns about z by 2·atan t and leaves z exactly unchanged.
Pose yawed(double t, double z) { return at(0, 0, z, Quat{0, 0, t, 1}); }

Scenario stacked(const std::string& name, const std::string& line, const Pose& upper) {
  return pair("degenerate", name, line, {cube, {}, {}}, {cube, upper, {}},
              gap_is(-0.125, 0, Vec3::UnitZ(), "0.5 + 0.5 - 0.875 along z, far more sideways"));
}

struct Tilt {
  double t;  // q = (0, t, 0, 1): about y by a = 2·atan t
  double sine() const { return 2 * t / (1 + t * t); }
  double cosine() const { return (1 - t * t) / (1 + t * t); }
  Pose at_height(double z) const { return at(0, 0, z, Quat{0, t, 0, 1}); }
};

// Lowest edge of the tilted box: h (sin a + cos a) below its centre.
Scenario stacked_tilted(const std::string& name, double t) {
  const Tilt tilt{t};
  return pair("degenerate", name, "stacked cubes, the upper one slightly tilted", {cube, {}, {}},
              {cube, tilt.at_height(0.875), {}},
              gap_is(-(0.5 + 0.5 * (tilt.sine() + tilt.cosine()) - 0.875), roundings(4, 1), Vec3::UnitZ(),
                     "0.5 + 0.5 (sin a + cos a) - 0.875"));
}

Scenario plates_tilted(const std::string& name, double t) {
  const Tilt tilt{t};
  return pair("degenerate", name, "a plate above a wider one, almost parallel",
              {Box{Vec3(4, 4, 0.125)}, {}, {}}, {Box{Vec3(1, 1, 0.125)}, tilt.at_height(0.5), {}},
              gap_is(0.5 - 0.125 - (tilt.sine() + 0.125 * tilt.cosine()), roundings(4, 1), Vec3::UnitZ(),
                     "0.5 - 0.125 - (sin a + 0.125 cos a)"));
}

// |y| + |z| <= 1, |x| <= 2.
Hull ridge() {
  return make_hull(
      {{-2, 0, 1}, {2, 0, 1}, {-2, 0, -1}, {2, 0, -1}, {-2, 1, 0}, {2, 1, 0}, {-2, -1, 0}, {2, -1, 0}});
}

}  // namespace

List degenerate_aligned() {
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  return {
      stacked("stacked_cubes", "equal cubes stacked exactly, an eighth deep", at(0, 0, 0.875)),
      stacked("stacked_cubes_offset_1e-16", "lateral offset at the rounding level of GJK's dot products",
              at(1e-16, 0, 0.875)),
      stacked("stacked_cubes_offset_1e-9", "lateral offset of a nanometre", at(1e-9, 1e-9, 0.875)),
      stacked("stacked_cubes_yaw_1e-17", "yaw far below an ulp", yawed(0.5e-17, 0.875)),
      stacked("stacked_cubes_yaw_1e-9", "yaw of a nanoradian", yawed(0.5e-9, 0.875)),
      stacked("stacked_cubes_yaw_1e-5", "yaw of ten microradians", yawed(0.5e-5, 0.875)),
      stacked("stacked_cubes_yaw_45", "an eight-cornered contact", yawed(0.41421356237309503, 0.875)),
      stacked_tilted("stacked_cubes_tilt_1e-13", 0.5e-13),
      stacked_tilted("stacked_cubes_tilt_1e-7", 0.5e-7),
      stacked_tilted("stacked_cubes_tilt_1e-3", 0.5e-3),
      plates_tilted("plates_tilted_2e-4", 1e-4),
      plates_tilted("plates_tilted_1e-9", 0.5e-9),
      pair("degenerate", "cubes_deep_on_the_diagonal", "three axes tie exactly", {cube, {}, {}},
           {cube, at(0.5, 0.5, 0.5), {}}, gap_is(-0.5, 0, x, "1 - 0.5 along each axis")),
      pair("degenerate", "ridges_nearly_parallel", "two edges cross at a microradian, 2^-4 apart",
           {ridge(), {}, {}}, {ridge(), at(0, 0, 2 + 0x1p-4, Quat{0, 0, 0x1p-21, 1}), {}},
           gap_is(0x1p-4, 0, z, "a turn about z does not change the heights of the ridges")),
      pair("degenerate", "capsules_nearly_parallel", "axes cross at a microradian, 1 apart",
           {Capsule{0.25, 4}, {}, {}}, {Capsule{0.25, 4}, at(1, 0, 0, Quat{0x1p-21, 0, 0, 1}), {}},
           gap_is(0.5, 0, x, "a turn about x keeps the axis in the plane x = 1")),
  };
}

}  // namespace touchstone::scenarios
