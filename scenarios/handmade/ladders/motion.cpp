// Bodies in motion: when do they first touch?
#include "scenarios/handmade/ladders/parts.h"

namespace touchstone::scenarios {
namespace {

Motion turning(double x, double y, double z) { return {Vec3::Zero(), Vec3(x, y, z)}; }

Scene through_plate(double thickness) {
  return two(Box{Vec3(2, 2, thickness)}, {}, Sphere{0.0625}, at(0.25, 0.125, 1), moving(0, 0, -2));
}
Scene cube_through_plate(double thickness) {
  return two(Box{Vec3(2, 2, thickness)}, {}, cube_of(0.0625), at(0.25, 0.125, 1), moving(0.25, 0, -2));
}
Scene plate_through_plate(double thickness) {
  return two(Box{Vec3(2, 2, thickness)}, {}, Box{Vec3(1, 1, thickness)}, at(0.25, 0.125, 4),
             moving(0, 0, -16));
}

Scene sphere_passes_sphere(double gap) {
  return two(Sphere{1}, {}, Sphere{0.5}, at(-3, 1.5 + gap, 0), moving(6, 0, 0));
}
Scene sphere_passes_edge(double gap) {
  return two(cube_of(1), {}, Sphere{0.5}, at(-3, 0.125, 1.5 + gap), moving(6, 0, 0));
}
Scene cube_passes_corner(double gap) {
  return two(cube_of(1), {}, cube_of(1), at(-4, 2 + gap, 2), moving(8, 0, 0));
}
Scene capsule_passes_capsule(double gap) {
  return two(Capsule{0.5, 1}, {}, Capsule{0.25, 1}, at(-3, 0.75 + gap, 0.5), moving(6, 0, 0));
}

Scene start_apart_by(double gap) {
  return two(cube_of(1), {}, Sphere{0.5}, at(0.25, 0, 1.5 + gap), moving(0, 0, -1));
}
Scene start_touching_leaving(double gap) {
  return two(cube_of(1), {}, Sphere{0.5}, at(0.25, 0, 1.5 + gap), moving(0, 0, 1));
}
Scene start_touching_sliding(double gap) {
  return two(cube_of(1), {}, cube_of(0.5), at(0.25, 0, 1.5 + gap), moving(0.5, 0, 0));
}
Scene start_deep_leaving(double depth) {
  return two(cube_of(1), {}, Sphere{0.5}, at(0.25, 0, 1.5 - depth), moving(0, 0, 2));
}
Scene start_deep_entering(double depth) {
  return two(cube_of(1), {}, cube_of(0.5), at(0.25, 0, 1.5 - depth), moving(0, 0, -0.5));
}

// The gap at the end is v.
Scene end_at(double gap) {
  return two(cube_of(1), {}, Sphere{0.5}, at(0.25, 0, 2.5 + gap), moving(0, 0, -1));
}
Scene end_at_cubes(double gap) {
  return two(cube_of(1), {}, cube_of(0.5), at(0.25, 0, 3.5 + gap), moving(0, 0, -2));
}

Scene together(double gap) {
  const Motion m = moving(3, 1, -2);
  return scene_of("", {{cube_of(1), {}, m}, {cube_of(0.5), at(0.25, 0.125, 1.5 + gap), m}});
}
Scene at_rest(double gap) {
  return two(cube_of(1), {}, Sphere{0.5}, at(0.25, 0, 1.5 + gap), moving(0, 0, 0));
}
Scene tiny_step(double length) {
  return two(cube_of(1), {}, Sphere{0.5}, at(0.25, 0, 1.625), moving(0, 0, -length));
}
Scene tiny_step_touching(double length) {
  return two(cube_of(1), {}, Sphere{0.5}, at(0.25, 0, 1.5), moving(0, length, -length));
}

Scene fast_cubes(double speed) {
  return two(cube_of(0.5), {}, cube_of(0.5), at(speed / 2, 0.25, 0), moving(-speed, 0, 0));
}
Scene fast_spheres(double speed) {
  return two(Sphere{0.5}, {}, Sphere{0.5}, at(speed / 2, 0.5, 0), moving(-speed, 0, 0));
}
Scene fast_tips(double speed) {
  const Hull tip = make_hull({{0, 1, 0}, {-1, -0.5, 0}, {0, -0.5, -1}, {1, -0.5, 0}});
  return two(tip, {}, tip, at(speed / 2, 0, 0), moving(-speed, 0, 0));
}

Scene ball_on_floor(double half) {
  return two(Box{Vec3(half, 0.5, half)}, {}, Sphere{0.5}, at(half / 4, 2, half / 8), moving(0, -4, 0));
}
Scene cube_on_floor(double half) {
  return two(Box{Vec3(half, 0.5, half)}, {}, cube_of(0.5), at(half / 4, 2, half / 8, about_z(0.25)),
             moving(0, -4, 0));
}
Scene cube_at_long_wall(double half) {
  return two(Box{Vec3(half, 0.5, 1)}, {}, cube_of(0.0625), at(half / 2, -2, 0), moving(0, 3, 0));
}

Scene slides_on_face(double gap) {
  return two(Box{Vec3(4, 1, 1)}, {}, cube_of(0.5), at(-6, 0.25, 1.5 + gap), moving(12, 0, 0));
}
Scene slides_along_triangle(double gap) {
  return two(make_hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}), {}, Capsule{0.25, 0.5},
             at(-3, 1, 0.25 + gap, quarter_turn_y), moving(6, 0, 0));
}

Scene leaves(double speed) {
  return two(cube_of(1), {}, cube_of(0.5), at(0.25, 0, 1.75), moving(0, 0, speed));
}

Scene rod_turns_to_post(double angle) {
  return two(Box{Vec3(0.25, 0.25, 1)}, at(1.5, 1.5, 0), Box{Vec3(2, 0.125, 0.125)}, {}, turning(0, 0, angle));
}
Scene rod_turns_past_post(double angle) {
  return two(Sphere{0.25}, at(0, 2.5, 0), Box{Vec3(2, 0.125, 0.125)}, {}, turning(0, 0, angle));
}
Scene cube_turns_on_edge(double gap) {
  return two(Box{Vec3(4, 4, 0.5)}, {}, cube_of(0.5), at(0.25, 0, 0.5 + std::sqrt(0.5) + gap),
             turning(0, 2, 0));
}
Scene tumbles(double angle) {
  return two(Box{Vec3(4, 4, 0.5)}, {}, Capsule{0.25, 1}, at(0, 0, 3),
             {Vec3(0.5, 0, -3), Vec3(angle, angle / 2, 0)});
}

Scene corner_first(double x) { return two(cube_of(1), {}, cube_of(1), at(4 + x, 4, 4), moving(-4, -4, -4)); }
Scene edge_first(double x) { return two(cube_of(1), {}, cube_of(1), at(4 + x, 0.5, 4), moving(-4, 0, -4)); }
Scene sphere_to_corner(double x) {
  return two(cube_of(1), {}, Sphere{0.5}, at(3 + x, 3, 3), moving(-4, -4, -4));
}
Scene tip_to_edge(double x) {
  const Hull tip = make_hull({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  return two(Box{Vec3(1, 4, 1)}, {}, tip, at(3 + x, 0.5, 1), moving(-4, 0, 0));
}

Scene scaled_motion(double s) {
  return two(cube_of(s), {}, Sphere{s / 2}, at(3 * s, 0.25 * s, 0.5 * s), moving(-4 * s, 0, 0));
}
Scene scaled_cubes(double s) {
  return two(cube_of(s), at(0, 0, 0, skew_turn), cube_of(s / 2), at(3 * s, 0.25 * s, 0.5 * s),
             moving(-4 * s, 0, 0));
}
Scene motion_far(double d) {
  return two(cube_of(1), at(d, d, -d), Sphere{0.5}, at(d + 3, d + 0.25, -d), moving(-4, 0, 0));
}

}  // namespace

std::vector<Ladder> motion_ladders() {
  const std::vector<double> thin{0.125, 1e-2, 1e-3, 1e-4, 1e-6, 0};
  const std::vector<double> sides{-0.125, -1e-3, -1e-5, -1e-8, 0, 1e-8, 1e-5, 1e-3, 0.125};
  const std::vector<double> starts{0, 1e-12, 1e-9, 1e-6, 1e-3, 0.125};
  const std::vector<double> depths{1e-9, 1e-6, 1e-3, 0.125, 0.5, 1};
  const std::vector<double> ends{-0.125, -1e-3, -1e-6, -1e-9, 0, 1e-9, 1e-6, 1e-3, 0.125};
  const std::vector<double> lengths{5e-324, 1e-300, 1e-42, 1e-20, 1e-12, 1e-6, 0.125, 0.25};
  const std::vector<double> speeds{4, 100, 1e3, 1e4, 1e5, 1e6};
  const std::vector<double> halves{5, 50, 500, 5e3, 5e4, 5e5};
  const std::vector<double> angles{0.5, 0.75, 1, 1.5, 3, 6};
  const std::vector<double> scales{1e-6, 1e-4, 1e-3, 1e-2, 1, 1e3};
  return {
      {"sphere-through-plate", "tunnelling", "a small sphere through a plate of half thickness v", thin,
       through_plate},
      {"cube-through-plate", "tunnelling", "a small cube through a plate of half thickness v", thin,
       cube_through_plate},
      {"plate-through-plate", "tunnelling", "a fast plate through another, half thicknesses v", thin,
       plate_through_plate},
      {"sphere-passes-sphere", "grazing-motion", "a sphere passes another with gap v", sides,
       sphere_passes_sphere},
      {"sphere-passes-box", "grazing-motion", "a sphere passes over a box with gap v", sides,
       sphere_passes_edge},
      {"cube-passes-edge", "grazing-motion", "a cube passes another edge to edge with gap v", sides,
       cube_passes_corner},
      {"capsule-passes-capsule", "grazing-motion", "a capsule passes another with gap v", sides,
       capsule_passes_capsule},
      {"starts-near", "start-touching", "a sphere starts v above a face and falls", starts, start_apart_by},
      {"starts-near-and-leaves", "start-touching", "a sphere starts v above a face and leaves", starts,
       start_touching_leaving},
      {"starts-near-and-slides", "start-touching", "a cube starts v above a face and slides", starts,
       start_touching_sliding},
      {"starts-deep-and-leaves", "start-overlapping", "a sphere starts v deep and leaves", depths,
       start_deep_leaving},
      {"starts-deep-and-sinks", "start-overlapping", "a cube starts v deep and sinks", depths,
       start_deep_entering},
      {"sphere-ends-near", "end-of-step", "a sphere falls and ends at gap v", ends, end_at},
      {"cube-ends-near", "end-of-step", "a cube falls and ends at gap v", ends, end_at_cubes},
      {"move-together", "no-relative-motion", "both bodies move alike, gap v", sides, together},
      {"at-rest", "no-relative-motion", "a motion of zero, gap v", sides, at_rest},
      {"tiny-step", "tiny-motion", "a sphere an eighth above a face moves by v", lengths, tiny_step},
      {"tiny-step-touching", "tiny-motion", "a touching sphere moves by v along and into the face", lengths,
       tiny_step_touching},
      {"fast-cubes", "high-speed", "cubes meet at v lengths in the step", speeds, fast_cubes},
      {"fast-spheres", "high-speed", "spheres meet off centre at v lengths in the step", speeds,
       fast_spheres},
      {"fast-tips", "high-speed", "small tetrahedra meet at v lengths in the step", speeds, fast_tips},
      {"ball-on-floor", "large-target", "a ball falls on a floor of half extent v", halves, ball_on_floor},
      {"cube-on-floor", "large-target", "a tilted cube falls on a floor of half extent v", halves,
       cube_on_floor},
      {"cube-at-long-wall", "large-target", "a small cube flies at a wall of half length v", halves,
       cube_at_long_wall},
      {"slides-on-face", "sliding-motion", "a cube slides over a box with gap v", sides, slides_on_face},
      {"slides-along-triangle", "sliding-motion", "a capsule slides along a triangle with gap v", sides,
       slides_along_triangle},
      {"leaves",
       "separating-motion",
       "a cube a quarter above another leaves at speed v",
       {0, 1e-12, 1e-6, 1, 1e3, 1e6},
       leaves},
      {"rod-turns-to-post", "rotation", "a rod turns by v, a post in its way", angles, rod_turns_to_post},
      {"rod-turns-short-of-post", "rotation", "a rod turns by v, a ball just out of reach", angles,
       rod_turns_past_post},
      {"cube-turns-over-floor", "rotation", "a cube turns over a floor, its edge passing at gap v", sides,
       cube_turns_on_edge},
      {"tumbling-capsule",
       "fast-rotation",
       "a capsule falls and turns by about v radians",
       {0.5, 2, 6.25, 12.5, 31.25, 62.5},
       tumbles},
      {"fast-rod-and-post",
       "fast-rotation",
       "a rod turns by v, a post in its way",
       {6.25, 12.5, 31.25, 62.5, 100},
       rod_turns_to_post},
      {"corner-first", "vertex-path", "cubes approach along the diagonal, v off", sides, corner_first},
      {"edge-first", "vertex-path", "cubes approach edge to edge, v off", sides, edge_first},
      {"sphere-to-corner", "vertex-path", "a sphere approaches a corner, v off", sides, sphere_to_corner},
      {"tip-to-edge", "vertex-path", "a tip approaches an edge, v off", sides, tip_to_edge},
      {"scaled-sphere", "motion-scale", "a sphere flies at a cube, sizes v", scales, scaled_motion},
      {"scaled-cubes", "motion-scale", "a cube flies at a turned cube, sizes v", scales, scaled_cubes},
      {"motion-far",
       "far-from-origin",
       "a sphere flies at a cube at distance v",
       {1, 1e3, 1e5, 1e6, 1e7},
       motion_far},
  };
}

}  // namespace touchstone::scenarios
