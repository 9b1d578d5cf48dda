// Support mapping of a large hull by climbing along its edges (core/narrow/hull_graph.h). The vertex that
// farthest_vertex of all vertices finds, bit for bit:
//
// Let f be the support value as computed, t the true one, |f − t| <= e for all vertices. Climbing by f ends
// at a vertex with no neighbour of larger f. From there all vertices with f >= f_best − 2e that are joined to
// it by such are gathered: C. They hold a vertex of greatest t: otherwise the best of C by t had a neighbour
// of larger t (the polytope is convex), outside of C, with f < f_best − 2e and so t < f_best − e, less than t
// of the vertex of f_best. And from a vertex s with f(s) >= f_best there is a path of rising t to that
// greatest one, on it t >= f_best − e, f >= f_best − 2e: s is in C. So the first of the largest f in C is the
// first of all.
//
// Sums of three products in R: f is off by 3 u of |p||d|, by one more when p is rounded to R first: e = 5 u.
// Exits: one vertex alone in C, as nearly always; several; too many (a face seen head on): a look at all.
#pragma once

#include <span>

#include "core/math/wide.h"
#include "core/narrow/hull_graph.h"

namespace touchstone::narrow::fast {

/// Index of the first vertex farthest along d. The graph is not empty and belongs to v.
std::size_t farthest_vertex(const HullGraph& g, std::span<const Vec3> v, const V3<double>& d);
std::size_t farthest_vertex(const HullGraph& g, std::span<const Vec3> v, const V3<float>& d);

/// vertices_above of all vertices, in any order, but for some that rounding alone puts above `least`. One
/// more than `out` holds: there may be others.
std::size_t vertices_above(const HullGraph& g, std::span<const Vec3> v, const V3<double>& d, double least,
                           std::span<std::int32_t> out);
std::size_t vertices_above(const HullGraph& g, std::span<const Vec3> v, const V3<float>& d, float least,
                           std::span<std::int32_t> out);

/// A vertex without a higher neighbour, from `from`.
std::int32_t climb_from(const HullGraph& g, std::span<const Vec3> v, const V3<double>& d, std::int32_t from);

}  // namespace touchstone::narrow::fast
