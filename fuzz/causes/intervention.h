// One change to a case. Whether a fault survives it says what the fault depends on (BugLens, arXiv
// 2506.23281: a compiler bug is identified by the passes whose removal makes it vanish). To add one: a
// function in a file of interventions/, its declaration and its row here.
//
// Some changes are relative to the case (half the depth), others set a quantity to a fixed value whatever it
// was (an overlap of 1/256 of the smaller body): cases of one cause that were reduced differently then become
// alike.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// True when the case's first question is about two bodies, rather than about the scene.
inline bool asks_about_pair(const Case& c) {
  return !c.queries.empty() && is_pair_question(c.queries[0].question);
}

/// Each returns the changed case, or nothing if there is nothing to change. The result may be invalid; the
/// caller validates it.
std::optional<Case> round_to_float(const Case& c);
std::optional<Case> scale_up(const Case& c);
std::optional<Case> scale_down(const Case& c);
std::optional<Case> scale_up_little(const Case& c);
std::optional<Case> scale_down_little(const Case& c);
std::optional<Case> move_to_origin(const Case& c);
std::optional<Case> move_away(const Case& c);
std::optional<Case> move_far(const Case& c);
std::optional<Case> move_to_negative(const Case& c);
std::optional<Case> exchange(const Case& c);
std::optional<Case> ask_twice(const Case& c);
std::optional<Case> ask_last_only(const Case& c);
std::optional<Case> ask_overlap_first(const Case& c);
std::optional<Case> ask_contact_first(const Case& c);
std::optional<Case> ask_exchanged_first(const Case& c);
std::optional<Case> turn_by_1e_9(const Case& c);
std::optional<Case> turn_by_1e_6(const Case& c);
std::optional<Case> turn_by_1e_3(const Case& c);
std::optional<Case> turn_a(const Case& c);
std::optional<Case> turn_b(const Case& c);
std::optional<Case> align_a(const Case& c);
std::optional<Case> align_b(const Case& c);
std::optional<Case> align_world(const Case& c);
std::optional<Case> nudge(const Case& c);
std::optional<Case> press_by_rounding(const Case& c);
std::optional<Case> turn_world(const Case& c);
std::optional<Case> turn_world_y(const Case& c);
std::optional<Case> turn_world_z(const Case& c);
std::optional<Case> half_turn_world(const Case& c);
std::optional<Case> half_turn_world_z(const Case& c);
std::optional<Case> set_upright(const Case& c);
std::optional<Case> set_a_upright(const Case& c);
std::optional<Case> set_b_upright(const Case& c);
std::optional<Case> normalize_rotations(const Case& c);
std::optional<Case> box_as_hull(const Case& c);
std::optional<Case> sphere_as_ellipsoid(const Case& c);
std::optional<Case> sphere_as_capsule(const Case& c);
std::optional<Case> cylinder_as_hull(const Case& c);
std::optional<Case> a_as_sphere(const Case& c);
std::optional<Case> b_as_sphere(const Case& c);
std::optional<Case> a_as_cube(const Case& c);
std::optional<Case> b_as_cube(const Case& c);
std::optional<Case> as_touching_cubes(const Case& c);
std::optional<Case> as_pressed_cubes(const Case& c);
std::optional<Case> own_shapes(const Case& c);
std::optional<Case> reorder_hull(const Case& c);
std::optional<Case> grow_a(const Case& c);
std::optional<Case> grow_b(const Case& c);
std::optional<Case> grow_a_much(const Case& c);
std::optional<Case> grow_b_much(const Case& c);
std::optional<Case> make_equal(const Case& c);
std::optional<Case> halve_depth(const Case& c);
std::optional<Case> pull_apart(const Case& c);
std::optional<Case> push_together(const Case& c);
std::optional<Case> overlap_by_half(const Case& c);
std::optional<Case> overlap_by_quarter(const Case& c);
std::optional<Case> overlap_by_256th(const Case& c);
std::optional<Case> overlap_by_millionth(const Case& c);
std::optional<Case> overlap_by_billionth(const Case& c);
std::optional<Case> overlap_by_trillionth(const Case& c);
std::optional<Case> apart_by_trillionth(const Case& c);
std::optional<Case> apart_by_millionth(const Case& c);
std::optional<Case> apart_by_256th(const Case& c);
std::optional<Case> apart_by_half(const Case& c);
std::optional<Case> apart_by_four(const Case& c);
std::optional<Case> stop_turning(const Case& c);
std::optional<Case> turn_faster(const Case& c);
std::optional<Case> turn_slower(const Case& c);
std::optional<Case> turn_back(const Case& c);
std::optional<Case> stop_turning_a(const Case& c);
std::optional<Case> stop_turning_b(const Case& c);
std::optional<Case> let_a_turn(const Case& c);
std::optional<Case> let_b_turn(const Case& c);
std::optional<Case> move_b_only(const Case& c);
std::optional<Case> meet_head_on(const Case& c);
std::optional<Case> meet_early(const Case& c);
std::optional<Case> meet_half_way(const Case& c);
std::optional<Case> meet_late(const Case& c);
std::optional<Case> move_faster(const Case& c);
std::optional<Case> move_slower(const Case& c);
std::optional<Case> travel_twice_as_far(const Case& c);
std::optional<Case> as_turning_bar(const Case& c);
std::optional<Case> insert_final_poses(const Case& c);
std::optional<Case> move_in_place(const Case& c);
std::optional<Case> move_away_and_back(const Case& c);
std::optional<Case> reinsert(const Case& c);
std::optional<Case> query_twice(const Case& c);
std::optional<Case> query_afterwards(const Case& c);
std::optional<Case> insert_in_reverse(const Case& c);
std::optional<Case> add_body_first(const Case& c);
std::optional<Case> add_pair_first(const Case& c);
std::optional<Case> add_pair_last(const Case& c);
std::optional<Case> add_body_between(const Case& c);
std::optional<Case> release_static(const Case& c);
std::optional<Case> leave_groups(const Case& c);

/// By which scenes are scaled up and down.
inline constexpr double large_factor = 1024, small_factor = 16;

/// What an intervention puts before what the case has: only faults of the latter count.
struct Added {
  int bodies = 0;
  int bodies_amid = 0;           // after the case's first body
  int queries = 0;               // to the engine
  bool queries_doubled = false;  // as many as the case has
  int query_steps = 0;           // of the script
};

struct Intervention {
  std::string_view name;
  std::string_view change;   // for people: "scaled by 1024"
  std::string_view if_gone;  // what it means when the fault vanishes: "vanishes when …"
  std::optional<Case> (*changed)(const Case& c);
  /// How much it says about the cause when the fault vanishes: of several, the one that says most is named. 0
  /// says nothing by itself: a contact vanishes when the bodies are moved apart.
  int telling = 0;
  Added added = {};
  /// The kind of shape that is given as another, if only one is.
  std::optional<ShapeKind> replaces = std::nullopt;
  /// By what all lengths are multiplied, if they become smaller. What the engine claims must do so too.
  double shrinks_to = 1;
};
inline constexpr auto interventions = std::to_array<Intervention>({
    {"round_to_float", "numbers rounded to float", "needs numbers that floats cannot hold", round_to_float,
     220},
    {"scale_up", "scaled by 1024", "vanishes when scaled by 1024: an absolute tolerance", scale_up, 520},
    {"scale_down",
     "scaled by 1/1024",
     "vanishes when scaled by 1/1024: an absolute tolerance",
     scale_down,
     510,
     {},
     std::nullopt,
     1.0 / large_factor},
    {"scale_up_little", "scaled by 16", "vanishes when scaled by 16: an absolute tolerance", scale_up_little,
     500},
    {"scale_down_little",
     "scaled by 1/16",
     "vanishes when scaled by 1/16: an absolute tolerance",
     scale_down_little,
     490,
     {},
     std::nullopt,
     1.0 / small_factor},
    {"move_to_origin", "moved to the origin", "only far from the origin", move_to_origin, 290},
    {"move_away", "moved away from the origin", "only near the origin", move_away, 280},
    {"move_far", "moved to 2^20 times the size from the origin", "only near the origin", move_far, 0},
    {"move_to_negative", "moved to negative coordinates", "depends on the signs of coordinates",
     move_to_negative, 0},
    {"exchange", "A and B exchanged", "depends on the order of A and B", exchange, 450},
    {"ask_twice",
     "asked twice, the second answer counted",
     "only when asked for the first time",
     ask_twice,
     440,
     {.queries_doubled = true}},
    {"ask_last_only", "only the last question asked", "needs the questions before", ask_last_only, 430},
    {"ask_overlap_first",
     "asked after an overlap",
     "vanishes after a question about the overlap",
     ask_overlap_first,
     420,
     {.queries = 1}},
    {"ask_contact_first",
     "asked after a contact",
     "vanishes after a question about the contact",
     ask_contact_first,
     410,
     {.queries = 1}},
    {"ask_exchanged_first",
     "asked after the question with A and B exchanged",
     "vanishes after the question with A and B exchanged",
     ask_exchanged_first,
     400,
     {.queries = 1}},
    {"turn_by_1e_9", "B turned by 1e-9", "only in exact alignment: vanishes when turned by 1e-9",
     turn_by_1e_9, 480},
    {"turn_by_1e_6", "B turned by 1e-6", "only near alignment: vanishes when turned by 1e-6", turn_by_1e_6,
     470},
    {"turn_by_1e_3", "B turned by 1e-3", "only near alignment: vanishes when turned by 1e-3", turn_by_1e_3,
     460},
    {"turn_a", "A turned by half a radian", "depends on how A is turned", turn_a, 0},
    {"turn_b", "B turned by half a radian", "depends on how B is turned", turn_b, 0},
    {"align_a", "A turned so that an axis is along the normal", "depends on how A is turned", align_a, 0},
    {"align_b", "B turned so that an axis is along the normal", "depends on how B is turned", align_b, 0},
    {"align_world", "the world turned so that the normal is along x", "depends on the axes of the world",
     align_world, 245},
    {"nudge", "B moved to adjacent doubles", "vanishes when B moves by one rounding", nudge, 20},
    {"press_by_rounding", "B moved towards A by one rounding", "only where the bodies touch to the last bit",
     press_by_rounding, 10},
    {"turn_world", "the world turned by a quarter turn about x", "depends on the axes of the world",
     turn_world, 270},
    {"turn_world_y", "the world turned by a quarter turn about y", "depends on the axes of the world",
     turn_world_y, 260},
    {"turn_world_z", "the world turned by a quarter turn about z", "depends on the axes of the world",
     turn_world_z, 250},
    {"half_turn_world", "the world turned by half a turn about x", "depends on the directions of the world",
     half_turn_world, 240},
    {"half_turn_world_z", "the world turned by half a turn about z", "depends on the directions of the world",
     half_turn_world_z, 230},
    {"set_upright", "rotations removed", "only where a body is rotated", set_upright, 110},
    {"set_a_upright", "the rotation of A removed", "only where A is rotated", set_a_upright, 100},
    {"set_b_upright", "the rotation of B removed", "only where B is rotated", set_b_upright, 90},
    {"normalize_rotations", "quaternions normalized", "only for quaternions that are not unit",
     normalize_rotations, 580},
    {"box_as_hull",
     "boxes given as hulls",
     "a routine for boxes: vanishes when the box is given as a hull",
     box_as_hull,
     570,
     {},
     ShapeKind::box},
    {"sphere_as_ellipsoid",
     "spheres given as ellipsoids",
     "a routine for spheres: vanishes when the sphere is given as an ellipsoid",
     sphere_as_ellipsoid,
     560,
     {},
     ShapeKind::sphere},
    {"sphere_as_capsule",
     "spheres given as capsules of length 0",
     "a routine for spheres: vanishes when the sphere is given as a capsule",
     sphere_as_capsule,
     550,
     {},
     ShapeKind::sphere},
    {"cylinder_as_hull",
     "cylinders given as hulls of 64 sides",
     "a routine for cylinders: vanishes when the cylinder is given as a hull",
     cylinder_as_hull,
     540,
     {},
     ShapeKind::cylinder},
    {"a_as_sphere", "A given as a sphere", "depends on the shape of A: vanishes for a sphere", a_as_sphere,
     0},
    {"b_as_sphere", "B given as a sphere", "depends on the shape of B: vanishes for a sphere", b_as_sphere,
     0},
    {"a_as_cube", "A given as a cube", "depends on the shape of A: vanishes for a cube", a_as_cube, 0},
    {"b_as_cube", "B given as a cube", "depends on the shape of B: vanishes for a cube", b_as_cube, 0},
    {"as_touching_cubes", "two cubes that touch exactly in their place", "", as_touching_cubes, 0},
    {"as_pressed_cubes", "two cubes that overlap by one rounding in their place", "", as_pressed_cubes, 0},
    {"own_shapes", "every body with a shape of its own", "only where bodies share a shape", own_shapes, 300},
    {"reorder_hull", "vertices of hulls in reverse order", "depends on the order of a hull's vertices",
     reorder_hull, 530},
    {"grow_a", "A grown by an eighth", "depends on the size of A", grow_a, 70},
    {"grow_b", "B grown by an eighth", "depends on the size of B", grow_b, 60},
    {"grow_a_much", "A grown to 16 times its size, as far from B as before",
     "depends on the ratio of the sizes", grow_a_much, 50},
    {"grow_b_much", "B grown to 16 times its size, as far from A as before",
     "depends on the ratio of the sizes", grow_b_much, 40},
    {"make_equal", "the smaller body grown to the size of the larger", "only for bodies of different sizes",
     make_equal, 30},
    {"halve_depth", "the depth halved", "only for deep overlaps: vanishes when the depth is halved",
     halve_depth, 80},
    {"pull_apart", "the bodies moved apart", "only where the bodies overlap: vanishes when they are apart",
     pull_apart, 0},
    {"push_together", "the bodies moved together", "only where the bodies are apart or barely touch",
     push_together, 0},
    {"overlap_by_half", "overlapping by 1/2 of the smaller body",
     "vanishes when the overlap is half the smaller body", overlap_by_half, 0},
    {"overlap_by_quarter", "overlapping by 1/4 of the smaller body",
     "vanishes when the overlap is a quarter of the smaller body", overlap_by_quarter, 0},
    {"overlap_by_256th", "overlapping by 1/256 of the smaller body",
     "only for deep overlaps: vanishes for 1/256 of the smaller body", overlap_by_256th, 0},
    {"overlap_by_millionth", "overlapping by 2^-20 of the smaller body",
     "only for deep overlaps: vanishes for 2^-20 of the smaller body", overlap_by_millionth, 0},
    {"overlap_by_billionth", "overlapping by 2^-30 of the smaller body",
     "only for deep overlaps: vanishes for 2^-30 of the smaller body", overlap_by_billionth, 0},
    {"overlap_by_trillionth", "overlapping by 2^-40 of the smaller body",
     "only for deep overlaps: vanishes for 2^-40 of the smaller body", overlap_by_trillionth, 0},
    {"apart_by_trillionth", "apart by 2^-40 of the smaller body", "", apart_by_trillionth, 0},
    {"apart_by_millionth", "apart by 2^-20 of the smaller body", "", apart_by_millionth, 0},
    {"apart_by_256th", "apart by 1/256 of the smaller body", "", apart_by_256th, 0},
    {"apart_by_half", "apart by 1/2 of the smaller body", "", apart_by_half, 0},
    {"apart_by_four", "apart by 4 times the smaller body", "", apart_by_four, 0},
    {"stop_turning", "angular velocities removed", "only where a body turns", stop_turning, 210},
    {"turn_faster", "angular velocities four times as large", "only where bodies turn slowly", turn_faster,
     0},
    {"turn_slower", "angular velocities a quarter as large", "only where bodies turn fast", turn_slower, 200},
    {"turn_back", "bodies turning the other way", "depends on the sense of rotation", turn_back, 190},
    {"stop_turning_a", "A not turning", "only where A turns", stop_turning_a, 180},
    {"stop_turning_b", "B not turning", "only where B turns", stop_turning_b, 170},
    {"let_a_turn", "A turning", "only where A does not turn", let_a_turn, 160},
    {"let_b_turn", "B turning", "only where B does not turn", let_b_turn, 150},
    {"move_b_only", "A at rest, B with the relative velocity", "depends on which body moves", move_b_only,
     140},
    {"meet_head_on", "approaching along the normal, without turning, from apart", "", meet_head_on, 0},
    {"meet_early", "meeting at 1/16 of the step", "only for late impacts", meet_early, 0},
    {"meet_half_way", "meeting at half of the step", "", meet_half_way, 0},
    {"meet_late", "meeting at 15/16 of the step", "only for early impacts", meet_late, 0},
    {"move_faster", "64 times as fast, meeting at half of the step", "only for slow bodies", move_faster,
     130},
    {"move_slower", "1/64 as fast, meeting at half of the step", "only for fast bodies", move_slower, 120},
    {"travel_twice_as_far", "bodies travelling twice as far", "only for short ways", travel_twice_as_far, 0},
    {"as_turning_bar", "a bar that turns into a cube in their place", "", as_turning_bar, 0},
    {"insert_final_poses", "the script replaced by its last state",
     "needs the history of the script: vanishes when the last state is inserted at once", insert_final_poses,
     380},
    {"move_in_place", "every body moved to where it is", "only for bodies that were never moved",
     move_in_place, 370},
    {"move_away_and_back", "every body moved away and back", "only for bodies that were never moved away",
     move_away_and_back, 360},
    {"reinsert", "every body removed and inserted again", "only for bodies that were never removed", reinsert,
     350},
    {"query_twice",
     "queried twice, the second answer counted",
     "only the first query of a script",
     query_twice,
     340,
     {.query_steps = 1}},
    {"query_afterwards", "queried once more afterwards", "only the last query of a script", query_afterwards,
     330},
    {"insert_in_reverse", "bodies in reverse order", "depends on the order of the bodies", insert_in_reverse,
     390},
    {"add_body_first",
     "a distant body added before the others",
     "depends on the numbers of the bodies",
     add_body_first,
     0,
     {.bodies = 1}},
    {"add_pair_first",
     "a distant pair added before the others",
     "only the first pair",
     add_pair_first,
     0,
     {.bodies = 2}},
    {"add_pair_last", "a distant pair added after the others", "only the last pair", add_pair_last, 0},
    {"add_body_between",
     "a distant body added between the others",
     "depends on the numbers of the bodies",
     add_body_between,
     0,
     {.bodies_amid = 1}},
    {"release_static", "no body static", "only where a body is static", release_static, 320},
    {"leave_groups", "no filters", "only with filters", leave_groups, 310},
});

}  // namespace touchstone::fuzz
