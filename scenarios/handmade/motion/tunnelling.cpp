// Fast bodies against thin ones: sampled checks step over the contact. Powers of two make the times exact.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

TriangleMesh wall_of_two_triangles() {
  return {{{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace

List motion_tunnelling() {
  const Sphere bullet{0x1p-7};
  const Box wall{Vec3(0x1p-8, 1, 1)};
  const Box plate{Vec3(0.5, 0.5, 0x1p-12)};
  return {
      pair("motion", "bullet_through_thin_wall", "a step of 64 through a wall of 2^-7: both ends are clear",
           {wall, {}, {}}, {bullet, at(-32, 0.25, 0.125), moving(64, 0, 0)},
           hit_at(0.5 - 0x3p-14, 0, "(32 - 2^-8 - 2^-7) / 64")),
      pair("motion", "plate_through_plate", "one thin plate passes face-on through another", {plate, {}, {}},
           {plate, at(0.125, 0, -8), moving(0, 0, 16)}, hit_at(0.5 - 0x1p-15, 0, "(8 - 2·2^-12) / 16")),
      pair("motion", "bullet_past_the_rim", "misses the wall's edge by 2^-10", {wall, {}, {}},
           {bullet, at(-32, 1 + 0x1p-7 + 0x1p-10, 0), moving(64, 0, 0)}, no_hit("nearest 2^-10 in y")),
      pair("motion", "bullet_grazes_the_rim", "touches the wall's edge without entering", {wall, {}, {}},
           {bullet, at(-32, 1 + 0x1p-7, 0), moving(64, 0, 0)},
           // |y - 1| is the radius: contact needs x in [-2^-8, 2^-8].
           hit_at(0.5 - 0x1p-14, 0, "(32 - 2^-8) / 64")),
      pair("motion", "bullets_meet_head_on", "both bodies move", {bullet, at(-16, 0, 0), moving(32, 0, 0)},
           {bullet, at(16, 0, 0), moving(-32, 0, 0)}, hit_at(0.5 - 0x1p-12, 0, "(32 - 2^-6) / 64")),
      pair("motion", "cubes_at_high_speed", "unit cubes approaching at 2000 per step",
           {Box{Vec3(0.5, 0.5, 0.5)}, {}, moving(1000, 0, 0)},
           {Box{Vec3(0.5, 0.5, 0.5)}, at(1001, 0.25, 0), moving(-1000, 0, 0)},
           hit_at(0.5, 0, "(1001 - 1) / 2000")),
      pair("motion", "bullet_through_mesh_diagonal", "the ball meets a surface at an inner edge",
           {wall_of_two_triangles(), {}, {}}, {bullet, at(-32, 0, 0), moving(64, 0, 0)},
           hit_at(0.5 - 0x1p-13, 0, "(32 - 2^-7) / 64")),
      pair("motion", "ball_into_the_ground", "a half-space stops everything",
           {HalfSpace{Vec3(0, 0, 2), 0}, {}, {}}, {Sphere{1}, at(3, 0, 10), moving(100, 0, -18)},
           hit_at(0.5, 0, "(10 - 1) / 18")),
      pair("motion", "capsule_through_rod", "crossed rods, one swept across the other",
           {Capsule{0x1p-8, 1}, {}, {}},
           {Capsule{0x1p-8, 1}, at(-16, 0, 0, quarter_turn_x), moving(32, 0, 0)},
           hit_at(0.5 - 0x1p-12, 0, "(16 - 2·2^-8) / 32")),
  };
}

}  // namespace touchstone::scenarios
