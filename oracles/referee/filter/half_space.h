// A half-space against anything: the gap is one support value along its normal, exact for polytopes and
// rounded shapes.
#pragma once

#include "oracles/referee/filter/convex.h"

namespace touchstone::referee {

/// Approximates the exact set as {x : normal·(x - origin) <= offset}: each component of normal is within
/// normal_error, offset within offset_error.
struct Plane {
  Real3 normal;
  Real offset = 0;
  Real normal_error = 0, offset_error = 0;
};
/// nullopt: the placement's matrix is singular, so there is no half-space.
std::optional<Plane> plane_of(const Placed& half_space, const Vec3& origin);

/// h is the half-space. The normal of the result points out of it, towards the body.
ConvexTruth judge_half_space(const Placed& h, const Operand& body, const Vec3& origin);

/// Two half-spaces. They are disjoint only if antiparallel; otherwise they overlap with infinite depth.
ConvexTruth judge_half_spaces(const Placed& a, const Placed& b, const Vec3& origin);

}  // namespace touchstone::referee
