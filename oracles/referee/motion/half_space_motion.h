// Two half-spaces in motion.
#pragma once

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// The angular velocity, or zero when it is exactly along the half-space's normal and so does not move it.
Vec3 visible_turn(const Placed& half_space, const Vec3& angular);

/// Both bodies are half-spaces. Always decided, except for two that face each other and turn alike.
TimeTruth judge_half_spaces_in_motion(const Placed& a, const Motion& motion_a, const Placed& b,
                                      const Motion& motion_b);
/// Signed gap at t; unknown when they turn.
Bracket gap_of_half_spaces(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                           double t);

}  // namespace touchstone::referee
