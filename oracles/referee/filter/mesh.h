// A mesh is the union of its triangles: verdict and distance are those of the nearest triangle.
#pragma once

#include "oracles/referee/filter/convex.h"

namespace touchstone::referee {

/// The convex parts of a body: the triangles of a mesh, or the body itself.
std::vector<Operand> parts_of(const Placed& p, const Vec3& origin);

/// Union against union. `surface`: one of the two is a mesh; an overlap then means lo = -inf, hi = 0.
ConvexTruth judge_parts(std::span<const Operand> a, std::span<const Operand> b, bool surface);
/// The gap of the two parts that overlap most. Precondition: some parts overlap.
Bracket gap_of_deepest(std::span<const Operand> a, std::span<const Operand> b);
ConvexTruth judge_parts_half_space(std::span<const Operand> a, const Placed& half_space, const Vec3& origin,
                                   bool surface);

}  // namespace touchstone::referee
