// Contact by rotation: engines that sweep translations only, or that interpolate vertices linearly, miss it.
#include <cmath>

#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

constexpr double quarter_pi = 0.78539816339744830962;

Motion spinning(double z) { return {Vec3::Zero(), Vec3(0, 0, z)}; }

// A rod along x turns about z towards a post at (0, d, 0). At angle a the post is d·cos a from the rod's
// axis, and d·sin a along it; radii add to 1/8.
Scenario rod_and_post(const std::string& name, const std::string& line, double d, double omega,
                      Expectation e) {
  return pair("motion", name, line, {Sphere{0x1p-4}, at(0, d, 0), {}},
              {Capsule{0x1p-4, 1}, at(0, 0, 0, quarter_turn_y), spinning(omega)}, std::move(e));
}

// Solid [2,3] × [-1/2,1/2]², seen from its body's origin.
Hull bar_off_centre() {
  std::vector<Vec3> v;
  for (double x : {2.0, 3.0})
    for (double y : {-0.5, 0.5})
      for (double z : {-0.5, 0.5}) v.emplace_back(x, y, z);
  return make_hull(std::move(v));
}

}  // namespace

List motion_rotation() {
  const double touch = std::acos(0.25);
  return {
      rod_and_post("rod_spins_into_post", "a rod turning in place meets a post", 0.5, 2,
                   hit_at(touch / 2, roundings(4, 1), "0.5 cos a = 1/8: a = acos 1/4, t = a/2")),
      rod_and_post("rod_spins_fast", "150 rad per step: two dozen turns, with contact in the first", 0.5, 150,
                   hit_at(touch / 150, roundings(4, 1), "t = acos(1/4) / 150")),
      rod_and_post(
          "rod_spins_backwards", "the other half of the rod meets the post from the other side", 0.5, -2,
          hit_at(touch / 2, roundings(4, 1), "mirror image: the rod's other half arrives at the same angle")),
      rod_and_post("rod_spins_clear", "the post is 2^-10 beyond the reach of the tip", 1.125 + 0x1p-10, 6,
                   no_hit("reach 1 + 2^-4, post from 1.125 + 2^-10 - 2^-4")),
      pair("motion", "cube_turns_into_wall", "a cube's corner swings into a wall that its faces never meet",
           {Box{Vec3(1, 4, 4)}, at(2.25, 0, 0), {}}, {Box{Vec3(1, 1, 1)}, {}, spinning(1)},
           // The corner reaches cos a + sin a = sqrt2·sin(a + pi/4).
           hit_at(std::asin(1.25 / std::sqrt(2.0)) - quarter_pi, roundings(8, 1), "cos t + sin t = 1.25")),
      pair("motion", "bar_swings_about_a_far_origin", "the solid is far from its centre of rotation",
           {Sphere{0.5}, at(0, 2.5, 0), {}}, {bar_off_centre(), {}, spinning(2)},
           // In the bar's frame the ball's centre is 2.5 (sin a, cos a): above the face y = 1/2 by 1/2 when
           // cos a = 0.4, and there sin a = 0.917 puts it over x = 2.29, inside [2,3]; before, it is farther
           // from face and edges.
           hit_at(std::acos(0.4) / 2, roundings(4, 1), "2.5 cos a - 1/2 = 1/2")),
      pair("motion", "ball_spins_in_place", "rotation of a ball about its centre changes nothing",
           {Box{Vec3(1, 1, 1)}, {}, {}},
           {Sphere{1}, at(2 + 0x1p-20, 0, 0), Motion{Vec3::Zero(), Vec3(7, 100, -30)}},
           no_hit("gap 2^-20 throughout")),
      pair("motion", "cylinder_spins_about_its_axis", "rotation about the axis of symmetry changes nothing",
           {Box{Vec3(1, 1, 1)}, {}, {}}, {Cylinder{1, 1}, at(2 + 0x1p-10, 0, 0), spinning(50)},
           no_hit("gap 2^-10 throughout")),
      pair("motion", "spinning_bullet", "a fast spinning ball hits as if it did not spin",
           {Box{Vec3(0x1p-8, 1, 1)}, {}, {}},
           {Sphere{0x1p-7}, at(-32, 0.25, 0.125), Motion{Vec3(64, 0, 0), Vec3(300, -200, 100)}},
           hit_at(0.5 - 0x3p-14, 0, "as without spin")),
  };
}

}  // namespace touchstone::scenarios
