// Support mapping of a large hull by climbing along its edges (core/shape/hull_graph.h). Finds the same
// vertex, bit for bit, as farthest_vertex over all vertices:
//
// Let f be the computed support value, t the true one, and |f − t| <= e for all vertices. Climbing by f ends
// at a vertex with no neighbour of larger f. From there, gather the set C of all vertices with
// f >= f_best − 2e that are connected to it through such vertices. C contains a vertex of greatest t:
// otherwise the best of C by t has a neighbour of larger t (the polytope is convex) outside C, with
// f < f_best − 2e and hence t < f_best − e, which is less than t of the vertex of f_best. And from a vertex s
// with f(s) >= f_best there is a path of increasing t to that greatest vertex, on which t >= f_best − e and
// f >= f_best − 2e: s is in C. So the first of the largest f in C is the first of all vertices.
//
// Sums of three products in R: f is off by 3 u of |p||d|, and by one more when p is rounded to R first:
// e = 5 u. Outcomes: C has one vertex, as nearly always; several; or too many (a face seen head-on), in which
// case all vertices are scanned.
#pragma once

#include <span>

#include "core/math/wide.h"
#include "core/shape/hull_graph.h"

namespace touchstone::convex {

/// Index of the first vertex farthest along d. The graph is not empty and belongs to v.
std::size_t farthest_vertex(const HullGraph& g, std::span<const Vec3> v, const V3<double>& d);
std::size_t farthest_vertex(const HullGraph& g, std::span<const Vec3> v, const V3<float>& d);

/// As vertices_above over all vertices, but in any order, and without some that only rounding puts above
/// `least`. A result of out.size() + 1 means that there may be more.
std::size_t vertices_above(const HullGraph& g, std::span<const Vec3> v, const V3<double>& d, double least,
                           std::span<std::int32_t> out);
std::size_t vertices_above(const HullGraph& g, std::span<const Vec3> v, const V3<float>& d, float least,
                           std::span<std::int32_t> out);

/// Climbs from `from` to a vertex without a higher neighbour.
std::int32_t climb_from(const HullGraph& g, std::span<const Vec3> v, const V3<double>& d, std::int32_t from);

}  // namespace touchstone::convex
