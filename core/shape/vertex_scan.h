// Support mapping of many vertices by scanning all of them with SIMD comparisons. The result is the same
// vertex on every processor: products and sums in one fixed order, and the first of equal vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/math/wide.h"

namespace touchstone::convex {

/// Index of the first vertex farthest along d. v is not empty.
std::size_t farthest_vertex(std::span<const Vec3> v, const V3<double>& d);

/// The same in float, for vertices rounded to float.
std::size_t farthest_vertex(std::span<const Vec3> v, const V3<float>& d);

/// Indices of the vertices with d·p >= least, in order. Writes at most out.size() of them and returns their
/// total number.
std::size_t vertices_above(std::span<const Vec3> v, const V3<double>& d, double least,
                           std::span<std::int32_t> out);
std::size_t vertices_above(std::span<const Vec3> v, const V3<float>& d, float least,
                           std::span<std::int32_t> out);

/// Square of the largest distance from the origin.
double largest_norm_sq(std::span<const Vec3> v);

}  // namespace touchstone::convex
