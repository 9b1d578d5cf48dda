// Helpers for writing ladders.
#pragma once

#include <cmath>
#include <utility>

#include "scenarios/handmade/build.h"
#include "scenarios/handmade/ladders/ladder.h"

namespace touchstone::scenarios {

inline Box cube_of(double half) { return Box{Vec3(half, half, half)}; }

/// A turn by `angle` about an axis of the world.
inline Quat about_x(double angle) { return {std::sin(angle / 2), 0, 0, std::cos(angle / 2)}; }
inline Quat about_y(double angle) { return {0, std::sin(angle / 2), 0, std::cos(angle / 2)}; }
inline Quat about_z(double angle) { return {0, 0, std::sin(angle / 2), std::cos(angle / 2)}; }

/// A turn that is aligned with nothing; exact in doubles.
inline constexpr Quat skew_turn{0.25, -0.5, 0.125, 0.75};
inline constexpr Quat other_turn{-0.375, 0.25, 0.5, 0.625};

inline Scene two(Shape a, const Pose& pose_a, Shape b, const Pose& pose_b) {
  return scene_of("", {{std::move(a), pose_a, {}}, {std::move(b), pose_b, {}}});
}
/// B moves.
inline Scene two(Shape a, const Pose& pose_a, Shape b, const Pose& pose_b, const Motion& motion_b) {
  return scene_of("", {{std::move(a), pose_a, {}}, {std::move(b), pose_b, motion_b}});
}

}  // namespace touchstone::scenarios
