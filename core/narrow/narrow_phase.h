// The public interface of the narrow phase: overlap, signed distance and contact of two placed shapes, which
// come from colliders, Collider::at(pose), or from shapes as they are, {&shape, pose}. Every pair is
// supported except half-space–half-space (`unsupported`). Results are computed in double with a
// proven error bound; where that bound cannot decide a verdict or exceeds τ, they are computed in extended
// precision on the exact pose and rounded once.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/narrow/collider.h"
#include "core/narrow/result.h"

namespace touchstone {

/// Corners of two polytopes, by number: of the facet of their difference in which the depth was found, and a
/// pair of the other side. Negative: unknown.
struct TouchingFeatures {
  std::array<std::array<std::int32_t, 3>, 2> corner{{{-1, -1, -1}, {-1, -1, -1}}};
  std::array<std::int32_t, 2> opposite{-1, -1};
};

/// Cached state of a pair that a caller may keep between queries of any kind, so that a search starts where
/// the last one ended: a separating direction or the last normal, and for overlapping polytopes the features
/// that touched, whose depth is the answer if a proof shows that it is still the least. It is only a guess:
/// verdicts, bounds and their proofs do not depend on it, and numbers vary only within their bounds. It
/// belongs to the ordered pair.
struct PairMemory {
  Vec3 direction = Vec3::Zero();  // in a body's frame; zero: unknown
  TouchingFeatures features;
};

/// float64: as described above. float64_alone: double only, without the fallback to extended precision: the
/// verdict is the sign of the gap however small, and the outcome is `not_converged` where double cannot
/// resolve the gap to the required accuracy. float32: poses and sizes are rounded to float and everything is
/// computed in float; meshes are `unsupported`.
enum class Arithmetic { float64, float64_alone, float32 };

/// Gap, normal and witness points before rounding to double. Coordinates are relative to A's translation.
Separation separation(const PlacedShape& a, const PlacedShape& b);

OverlapAnswer overlap(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic = Arithmetic::float64,
                      PairMemory* memory = nullptr);

/// Minus the depth for bodies that overlap; of a solid mesh that is not convex: as for contact().
/// For a convex body that hits a mesh: minus the depth in the deepest triangle; for two meshes that meet: of
/// the deepest pair of triangles.
DistanceAnswer distance(const PlacedShape& a, const PlacedShape& b,
                        Arithmetic arithmetic = Arithmetic::float64, PairMemory* memory = nullptr);

/// For a mesh: normal, depth and point of the deepest triangle or pair of triangles; or of the mesh's plane,
/// where that is all of the mesh as far as a convex body reaches through it. The normal minimises the depth
/// over directions; with a solid mesh that is not convex, over those that core/narrow/solid.h names, and the
/// manifold is one point.
ContactAnswer contact(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic = Arithmetic::float64,
                      PairMemory* memory = nullptr);

/// Reduces a manifold to at most four points: the deepest, the one farthest from it, and on either side of
/// the line through both the one that spans the largest area.
Manifold reduced(const ContactAnswer& contact);

// One pair of shapes in many pairs of poses: samples of a path, of a grasp, of a configuration space. The
// answers are those of overlap() for each pair of poses, bit for bit, on every processor. Two boxes are
// tested several poses at a time, one in each lane of the processor's vectors; other shapes one after the
// other.

/// out[i]: whether A at poses_a[i] and B at poses_b[i] overlap, as overlap(a.at(poses_a[i]),
/// b.at(poses_b[i])). Throws std::invalid_argument unless the three are of the same length.
void overlaps(const Collider& a, std::span<const Pose> poses_a, const Collider& b,
              std::span<const Pose> poses_b, std::span<OverlapAnswer> out);

}  // namespace touchstone
