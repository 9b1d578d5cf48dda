// Truth of one pair of bounded convex bodies: the building block of judge_pair, meshes (triangle by triangle)
// and motions.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>

#include "core/math/aabb.h"
#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/filter/body.h"
#include "oracles/referee/filter/inner_polytope.h"

namespace touchstone::referee {

/// A bounded convex body for the filter and, if it has an exact form (a curved body has none), for the exact
/// level: either `exact`, or `placed`, from which the exact form is built only when needed.
struct Operand {
  Solid body;
  std::optional<ExactBody> exact;
  Placed placed{};
  bool has_exact() const { return exact || (placed.shape != nullptr && core_form(placed).has_points()); }
  ExactBody exact_body() const;
};
/// The shape must be convex and bounded. `origin`: the filter's numbers are relative to it.
Operand make_operand(const Placed& p, const Vec3& origin);
Operand make_operand(const Placed& p, const TriangleMesh& mesh, std::size_t triangle, const Vec3& origin);

struct ConvexTruth {
  Verdict verdict = Verdict::undecided;
  Real lo = 0, hi = 0;  // of the signed gap, proven
  Real3 normal;         // A to B, near unit
  Real3 witness_a, witness_b;
  Real3 common;   // when overlapping: near a point in both
  int level = 1;  // as PairTruth::level
  std::optional<ExactVerdict> exact;
  /// The two parts that `exact` is about, when a mesh's triangle decided.
  std::vector<ExactBody> exact_operands;
  std::optional<InnerPolytope> inner;  // Effort::certificate, overlapping cores
  Real inner_depth = 0;  // depth that `inner` proves, balls included; symmetry may prove more (lo, hi)
  ExactPair exact_pair() const { return make_exact(exact_operands.at(0), exact_operands.at(1)); }
};

/// verdict_only: the bracket is as wide as deciding the verdict left it. certificate: the bracket is found
/// with an inner polytope in extended precision, which is kept.
enum class Effort { verdict_only, gap, certificate };
/// A pair that is farther apart than `enough` is judged as with verdict_only.
ConvexTruth judge_convex(const Operand& a, const Operand& b, std::span<const Real3> hints = {},
                         Effort effort = Effort::gap, Real enough = std::numeric_limits<Real>::infinity());

/// Doubles alone: proven bounds [lo, hi] of the gap when hi is at most `enough`; nullopt otherwise. Saves
/// most when bodies touch or overlap by a rounding, where a verdict needs more than doubles.
std::optional<std::array<double, 2>> gap_at_most(const Operand& a, const Operand& b, double enough);

/// The width, absolute, to which a bracket is refined before the referee stops.
Real target_width(const Difference& d);

// AABB of a body, rounded outward: six support values with their proven error.

/// The body's numbers must be relative to the world origin.
Aabb box_of(const Solid& b);

// A mesh is the union of its triangles: verdict and distance are those of the nearest triangle.

/// The convex parts of a body: the triangles of a mesh, or the body itself.
std::vector<Operand> parts_of(const Placed& p, const Vec3& origin);

/// Union against union. `surface`: one of the two is a mesh; an overlap then means lo = -inf, hi = 0.
ConvexTruth judge_parts(std::span<const Operand> a, std::span<const Operand> b, bool surface);
/// The gap of the two parts that overlap most. Precondition: some parts overlap.
Bracket gap_of_deepest(std::span<const Operand> a, std::span<const Operand> b);
ConvexTruth judge_parts_half_space(std::span<const Operand> a, const Placed& half_space, const Vec3& origin,
                                   bool surface);

}  // namespace touchstone::referee
