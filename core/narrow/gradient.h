// The gradient of the signed distance of A and B by the pose of B: how the distance changes, to first order,
// when B moves by v and turns by the rotation vector w (world axes, radians) about a point o: by normal·v +
// moment·w.
//
// Derivation: where the distance has one gradient, it is that of the distance between the tangent planes at
// the witness points (Danskin 1967): normal is the unit normal from A to B, and moment = (p − o) × normal for
// the witness point p on B, or any other point on the line through it along the normal. Where the witness
// points are not unique (a face on a face, an edge on an edge), each of them gives a gradient of the distance
// at poses nearby, and the derivative along (v, w) is the least of all normal·v + moment·w. Where several
// normals are best, which only bodies that overlap or touch have, the derivative is the largest of these over
// the normals.
#pragma once

#include <optional>
#include <vector>

#include "core/narrow/narrow_phase.h"

namespace touchstone {

/// Derivatives of the signed distance by the pose of B.
struct DistanceGradient {
  Vec3 normal = Vec3::Zero();  // by translations
  Vec3 moment = Vec3::Zero();  // by rotations about the stated point; a length
};

/// From an answer that has a normal and witness points: one gradient of possibly several. `about`: world.
/// Empty where bodies overlap with several normals of the same depth and the points belong to another one
/// than the answer's normal.
std::optional<DistanceGradient> gradient(const DistanceAnswer& answer, const Vec3& about);

struct DistanceGradients {
  Outcome outcome = Outcome::answered;
  /// The corners of the set of gradients that belong to the normal of distance(): one, or several at the ends
  /// of the line or at the corners of the polygon that the witness points fill. That of a round face is an
  /// inscribed polygon. At most 32.
  std::vector<DistanceGradient> corners;
  /// Whether there is no other gradient, for bodies within rounding (tolerance::manifold_face_factor) of
  /// these. Empty: not known, because bodies that overlap may have another normal of the same depth, and
  /// bodies apart from a mesh another triangle at the same distance.
  std::optional<bool> unique;
};

/// Every pair that distance() supports. Computed in extended precision, about a hundred times slower than
/// distance().
DistanceGradients gradients(const PlacedShape& a, const PlacedShape& b, const Vec3& about);

}  // namespace touchstone
