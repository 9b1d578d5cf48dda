// The facets of a convex hull, found with exact signs, and whether hulls cover a triangle: the hulls are
// taken away from the triangle one after the other, in rational numbers.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/math/aabb.h"
#include "core/math/pose.h"
#include "oracles/referee/exact/rational.h"

namespace touchstone::fuzz {

/// Triangles (indices into `points`) of the surface of conv(points), each with every point of the hull on or
/// behind its plane, seen from outside; triangles of one facet may share a plane. Closed: each edge is in two
/// of them.
struct ExactHull {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> facets;
  Aabb box;
};

/// Incremental construction (Clarkson and Shor 1989, without their bookkeeping) with exact orientation tests;
/// time proportional to points times facets. nullopt for points in one plane.
std::optional<ExactHull> exact_hull(std::span<const Vec3> points);

/// Whether the point is in the closed hull, exactly.
bool contains(const ExactHull& hull, const Vec3& p);

using Triangle = std::array<Vec3, 3>;

/// A point of the closed triangle (also one that is flat: a segment or a point) that is in none of the closed
/// hulls; nullopt if every point is in one. Both are exact.
std::optional<referee::Rational3> uncovered_point(const Triangle& t, std::span<const ExactHull> pieces);

}  // namespace touchstone::fuzz
