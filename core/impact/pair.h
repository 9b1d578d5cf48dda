// The time of impact of a pair of shapes by its kind: what the rows of the table in impact.cpp consist of.
#pragma once

#include <optional>

#include "core/impact/filtered/translation.h"
#include "core/impact/impact.h"

namespace touchstone::impact {

/// First contact of two bodies that do not rotate, in closed form or not at all (`unsure`).
struct ClosedForm {
  filtered::Search (*solve)(const MovingShape& a, const MovingShape& b,
                            const filtered::Translation& m) = nullptr;
  bool has_points = true;  // a hit comes with its nearest points
};

struct Row;
using PairFunction = ImpactAnswer (*)(const MovingShape&, const MovingShape&, ImpactDetail, const Row&);

/// A default row: the pair is unsupported.
struct Row {
  PairFunction function = nullptr;
  ClosedForm translation = {};
  bool cast = false;  // translations by translating_polytopes(), for two polytopes
  constexpr explicit operator bool() const { return function != nullptr; }
};

/// The functions of rows. Precondition: A is bounded and convex, and a B that is not is at rest, if the
/// function says nothing else.
ImpactAnswer convex_convex(const MovingShape& a, const MovingShape& b, ImpactDetail detail, const Row& row);
ImpactAnswer convex_half_space(const MovingShape& a, const MovingShape& b, ImpactDetail detail,
                               const Row& row);
ImpactAnswer convex_mesh(const MovingShape& a, const MovingShape& b, ImpactDetail detail, const Row& row);
/// Either may move, and either may be a mesh or bounded and convex.
ImpactAnswer moving_parts(const MovingShape& a, const MovingShape& b, ImpactDetail detail, const Row& row);
/// A mesh that moves and a half-space at rest.
ImpactAnswer mesh_half_space(const MovingShape& a, const MovingShape& b, ImpactDetail detail, const Row& row);

/// Whether they meet at t = 0, and how, in bounded time. A depth that double cannot prove to be the least
/// still decides the verdict and is reported: it does separate them, and no time depends on it. (In extended
/// precision, two ellipsoids about one centre take up to a minute: every facet that the polytope may have.)
std::optional<ImpactAnswer> contact_at_start(const MovingShape& a, const MovingShape& b, ImpactDetail detail);

/// A lower bound of the body's part of the scale L, which τ is relative to. `extent`: of its shape.
double scale_of(const MovingShape& s, double extent);

/// Accuracy of the gap at a reported contact of a pair of that scale.
double accuracy_of(double scale);

/// Witness points that are relative to a body's start, in the world.
ImpactAnswer shift_witnesses(ImpactAnswer r, const Vec3& origin);

}  // namespace touchstone::impact
