// One change to a case. Whether a fault survives it says what the fault depends on (BugLens, arXiv
// 2506.23281: a compiler bug is identified by the passes whose removal makes it vanish). To add one: a
// function in a file of interventions/, its declaration and its row here.
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
std::optional<Case> move_to_origin(const Case& c);
std::optional<Case> move_away(const Case& c);
std::optional<Case> exchange(const Case& c);
std::optional<Case> turn_by_1e_9(const Case& c);
std::optional<Case> turn_by_1e_6(const Case& c);
std::optional<Case> turn_by_1e_3(const Case& c);
std::optional<Case> nudge(const Case& c);
std::optional<Case> turn_world(const Case& c);
std::optional<Case> set_upright(const Case& c);
std::optional<Case> normalize_rotations(const Case& c);
std::optional<Case> box_as_hull(const Case& c);
std::optional<Case> sphere_as_ellipsoid(const Case& c);
std::optional<Case> sphere_as_capsule(const Case& c);
std::optional<Case> cylinder_as_hull(const Case& c);
std::optional<Case> reorder_hull(const Case& c);
std::optional<Case> grow_a(const Case& c);
std::optional<Case> grow_b(const Case& c);
std::optional<Case> halve_depth(const Case& c);
std::optional<Case> pull_apart(const Case& c);
std::optional<Case> push_together(const Case& c);
std::optional<Case> stop_turning(const Case& c);
std::optional<Case> move_b_only(const Case& c);
std::optional<Case> insert_final_poses(const Case& c);
std::optional<Case> insert_in_reverse(const Case& c);
std::optional<Case> add_body_first(const Case& c);
std::optional<Case> add_pair_first(const Case& c);
std::optional<Case> add_pair_last(const Case& c);
std::optional<Case> release_static(const Case& c);
std::optional<Case> leave_groups(const Case& c);

struct Intervention {
  std::string_view name;
  std::string_view change;   // for people: "scaled by 1024"
  std::string_view if_gone;  // what it means when the fault vanishes: "vanishes when …"
  std::optional<Case> (*changed)(const Case& c);
  int added_first = 0;  // bodies that come before those of the case; only faults of the latter count
};
inline constexpr auto interventions = std::to_array<Intervention>({
    {"round_to_float", "numbers rounded to float", "needs numbers that floats cannot hold", round_to_float},
    {"scale_up", "scaled by 1024", "vanishes when scaled by 1024: an absolute tolerance", scale_up},
    {"scale_down", "scaled by 1/1024", "vanishes when scaled by 1/1024: an absolute tolerance", scale_down},
    {"move_to_origin", "moved to the origin", "only far from the origin", move_to_origin},
    {"move_away", "moved away from the origin", "only near the origin", move_away},
    {"exchange", "A and B exchanged", "depends on the order of A and B", exchange},
    {"turn_by_1e_9", "B turned by 1e-9", "only in exact alignment: vanishes when turned by 1e-9",
     turn_by_1e_9},
    {"turn_by_1e_6", "B turned by 1e-6", "only near alignment: vanishes when turned by 1e-6", turn_by_1e_6},
    {"turn_by_1e_3", "B turned by 1e-3", "only near alignment: vanishes when turned by 1e-3", turn_by_1e_3},
    {"nudge", "B moved to adjacent doubles", "vanishes when B moves by one rounding", nudge},
    {"turn_world", "the world turned by a quarter turn about x", "depends on the axes of the world",
     turn_world},
    {"set_upright", "rotations removed", "only where a body is rotated", set_upright},
    {"normalize_rotations", "quaternions normalized", "only for quaternions that are not unit",
     normalize_rotations},
    {"box_as_hull", "boxes given as hulls", "a routine for boxes: vanishes when the box is given as a hull",
     box_as_hull},
    {"sphere_as_ellipsoid", "spheres given as ellipsoids",
     "a routine for spheres: vanishes when the sphere is given as an ellipsoid", sphere_as_ellipsoid},
    {"sphere_as_capsule", "spheres given as capsules of length 0",
     "a routine for spheres: vanishes when the sphere is given as a capsule", sphere_as_capsule},
    {"cylinder_as_hull", "cylinders given as hulls of 64 sides",
     "a routine for cylinders: vanishes when the cylinder is given as a hull", cylinder_as_hull},
    {"reorder_hull", "vertices of hulls in reverse order", "depends on the order of a hull's vertices",
     reorder_hull},
    {"grow_a", "A grown by an eighth", "depends on the size of A", grow_a},
    {"grow_b", "B grown by an eighth", "depends on the size of B", grow_b},
    {"halve_depth", "the depth halved", "only for deep overlaps: vanishes when the depth is halved",
     halve_depth},
    {"pull_apart", "the bodies moved apart", "only where the bodies overlap: vanishes when they are apart",
     pull_apart},
    {"push_together", "the bodies moved together", "only where the bodies are apart or barely touch",
     push_together},
    {"stop_turning", "angular velocities removed", "only where a body turns", stop_turning},
    {"move_b_only", "A at rest, B with the relative velocity", "depends on which body moves", move_b_only},
    {"insert_final_poses", "the script replaced by its last state",
     "needs the history of the script: vanishes when the last state is inserted at once", insert_final_poses},
    {"insert_in_reverse", "bodies in reverse order", "depends on the order of the bodies", insert_in_reverse},
    {"add_body_first", "a distant body added before the others", "depends on the numbers of the bodies",
     add_body_first, 1},
    {"add_pair_first", "a distant pair added before the others", "only the first pair", add_pair_first, 2},
    {"add_pair_last", "a distant pair added after the others", "only the last pair", add_pair_last},
    {"release_static", "no body static", "only where a body is static", release_static},
    {"leave_groups", "no filters", "only with filters", leave_groups},
});

}  // namespace touchstone::fuzz
