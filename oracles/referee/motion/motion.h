// Moving parts and their boxes; the rest of the motion's interface is in referee.h.
#pragma once

#include <vector>

#include "core/math/aabb.h"
#include "oracles/referee/motion/course.h"
#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// Convex part a of A and part b of B in motion (triangle indices for meshes; 0 for any other shape).
struct PartPair {
  std::size_t a = 0, b = 0;
  Course course;
};
/// The pairs of parts that can meet during the step, in order. A must not be a half-space.
std::vector<PartPair> part_pairs(const Placed& a, const Motion& motion_a, const Placed& b,
                                 const Motion& motion_b);

/// Outward box of the part over the whole step, relative to `origin` (which is exact).
Aabb box_over(const Mover& m, const Vec3& origin);

/// The bodies meet first at some time in [lo, hi].
TimeTruth hit_between(double lo, double hi, const char* note = "");

// Two half-spaces in motion.

/// The angular velocity, or zero when it is exactly along the half-space's normal and so does not move it.
Vec3 visible_turn(const Placed& half_space, const Vec3& angular);

/// Both bodies are half-spaces. Always decided, except for two that face each other and turn alike.
TimeTruth judge_half_spaces_in_motion(const Placed& a, const Motion& motion_a, const Placed& b,
                                      const Motion& motion_b);
/// Signed gap at t; unknown when they turn.
Bracket gap_of_half_spaces(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                           double t);

}  // namespace touchstone::referee
