// The gradients of the signed distance by the pose of B (truth.md §2).
#pragma once

#include <span>
#include <vector>

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// Derivatives by translations of B, and by rotations of B about the origin of its frame along world axes.
struct Gradient {
  Vec3 normal = Vec3::Zero();
  Vec3 moment = Vec3::Zero();  // (p − origin) × normal
  Vec3 point = Vec3::Zero();   // p, half-way between the bodies' support planes
};

/// For each normal, the corners of the region in which the bodies face each other. The derivative along a
/// translation v and a rotation vector w is the largest, over the normals, of the least normal·v + moment·w
/// over the corners of that normal.
struct GradientSet {
  std::vector<Gradient> corners;
  /// There is one gradient, up to the slack, and no other normal is as good.
  bool unique = false;
};

/// Features of polytopes within this · L of their support planes face each other: rounded normals tilt them.
inline constexpr double gradient_slack_factor = 0x1p-40;

/// normals: all that are best (near_minimal_normals), or the only one; `complete` says whether they are.
/// Empty for meshes and for two half-spaces. l: the scale of the pair, > 0.
GradientSet gradient_set(const Placed& a, const Placed& b, std::span<const Vec3> normals, bool complete,
                         double l);

}  // namespace touchstone::referee
