// Contact at the ends of the interval, grazing, and zero motion.
#include <limits>

#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

Expectation with_gap(Expectation e, double gap) {
  e.gap = {gap, 0};
  e.overlap = gap <= 0;
  return e;
}

}  // namespace

List motion_boundaries() {
  const Box unit{Vec3(1, 1, 1)};
  const Sphere ball{1};
  const double least = std::numeric_limits<double>::denorm_min();
  return {
      pair("motion", "contact_at_the_very_end", "touching at t = 1 is contact", {unit, {}, {}},
           {unit, at(-3, 0, 0), moving(1, 0, 0)}, with_gap(hit_at(1, 0, "closed interval: (3 - 2) / 1"), 1)),
      pair("motion", "stops_just_short", "a gap of 2^-30 remains at t = 1", {unit, {}, {}},
           {unit, at(-3, 0, 0), moving(1 - 0x1p-30, 0, 0)}, with_gap(no_hit("gap 2^-30 at t = 1"), 1)),
      pair("motion", "overlapping_at_start_leaving", "already inside, on the way out", {unit, {}, {}},
           {unit, at(1.5, 0, 0), moving(10, 0, 0)}, with_gap(hit_at(0, 0, "overlap at t = 0"), -0.5)),
      pair("motion", "overlapping_at_start_at_rest", "already inside, not moving", {unit, {}, {}},
           {unit, at(1.5, 0, 0), moving(0, 0, 0)}, with_gap(hit_at(0, 0, "overlap at t = 0"), -0.5)),
      pair("motion", "touching_at_start_leaving", "touching at t = 0 is contact, whatever happens next",
           {unit, {}, {}}, {unit, at(2, 0, 0), moving(5, 0, 0)},
           with_gap(hit_at(0, 0, "closed interval"), 0)),
      pair("motion", "touching_at_start_entering", "touching at t = 0, then deeper", {ball, {}, {}},
           {ball, at(2, 0, 0), moving(-1, 0, 0)}, with_gap(hit_at(0, 0, "closed interval"), 0)),
      pair("motion", "rounded_edges_meet", "two round edges meet, faces do not",
           {RoundedBox{Vec3(1, 1, 1), 2}, {}, {}},
           {RoundedBox{Vec3(1, 1, 2), 3}, at(13, 6, 0.5), moving(-16, 0, 0)},
           hit_at(0.5, 0, "8 / 16: the edges of the cores are then |(3,4)| = 2 + 3 apart")),
      pair("motion", "slides_touching", "faces slide on each other from the start", {unit, {}, {}},
           {unit, at(0.5, 0, 2), moving(1, 0, 0)}, with_gap(hit_at(0, 0, "closed sets touch at t = 0"), 0)),
      pair("motion", "slides_a_hair_above", "parallel to the face at 2^-20", {unit, {}, {}},
           {unit, at(-4, 0, 2 + 0x1p-20), moving(8, 0, 0)}, no_hit("2^-20 apart along z throughout")),
      pair("motion", "slides_along_the_face_plane", "reaches touching faces from the side", {unit, {}, {}},
           {unit, at(-4, 0, 2), moving(4, 0, 0)},
           with_gap(hit_at(0.5, 0, "z touches always, x at (4 - 2) / 4"), 2)),
      pair("motion", "balls_graze", "the balls touch at a single moment", {ball, {}, {}},
           {ball, at(-8, 2, 0), moving(16, 0, 0)}, hit_at(0.5, 0, "distance is 2 at x = 0 only")),
      pair("motion", "balls_miss_by_2_to_the_minus_20", "nearest approach just outside", {ball, {}, {}},
           {ball, at(-8, 2 + 0x1p-20, 0), moving(16, 0, 0)}, no_hit("least gap 2^-20 at t = 0.5")),
      pair("motion", "moving_together", "large equal velocities, no relative motion",
           {unit, {}, moving(1e5, -1e5, 3)}, {unit, at(2.5, 0, 0), moving(1e5, -1e5, 3)},
           with_gap(no_hit("gap 0.5 throughout"), 0.5)),
      pair("motion", "no_motion_apart", "zero velocity", {unit, {}, {}},
           {unit, at(2.5, 0, 0), moving(0, 0, 0)}, with_gap(no_hit("gap 0.5 throughout"), 0.5)),
      pair("motion", "denormal_velocity", "the smallest positive velocity", {unit, {}, {}},
           {unit, at(2.5, 0, 0), moving(-least, 0, 0)}, with_gap(no_hit("gap 0.5 - 5e-324"), 0.5)),
      pair("motion", "aligned_cubes_head_on", "exactly aligned faces approach", {unit, {}, {}},
           {unit, at(-6, 0, 0), moving(8, 0, 0)}, with_gap(hit_at(0.5, 0, "(6 - 2) / 8"), 4)),
      pair("motion", "leaving", "moving straight away", {ball, {}, {}},
           {ball, at(3, 0, 0), moving(100, 0, 0)}, with_gap(no_hit("gap grows from 1"), 1)),
  };
}

}  // namespace touchstone::scenarios
