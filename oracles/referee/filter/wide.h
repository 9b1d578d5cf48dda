// 237-bit binary floating point, about 71 decimal digits, with a wide exponent: for a search that extended
// precision cannot finish. No result found in it is relied on: the checker's rationals decide.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "oracles/referee/filter/convex.h"
#include "oracles/referee/filter/real3.h"

namespace touchstone::referee {

using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<237, boost::multiprecision::digit_base_2, void, std::int32_t>,
    boost::multiprecision::et_off>;
using Wide3 = Triple<Wide>;

template <>
inline const Wide unit_of<Wide> = ldexp(Wide(1), -237);
template <>
inline const Wide value_rounding_of<Wide> = value_roundings* unit_of<Wide>;
template <>
inline const Wide difference_rounding_of<Wide> = difference_roundings* unit_of<Wide>;
template <>
inline const Wide dot_rounding_of<Wide> = dot_roundings* unit_of<Wide>;
template <>
inline const Wide projection_rounding_of<Wide> = projection_roundings* unit_of<Wide>;
template <>
inline const Wide least_square<Wide> = ldexp(Wide(1), -100000);

// The last level for pairs with a curved body for which extended precision cannot tell whether they overlap:
// the same search in 237-bit arithmetic. Its result is a rational plane or a rational point and counts only
// when the checker accepts it, so nothing there needs an error bound.

/// A separating_plane (several for a mesh) or common_point accepted by checker::check(), or kind none when
/// nothing is found. Half-spaces, and meshes of so many parts that it would take seconds, are not searched
/// (none).
Certificate search_wide(const Placed& a, const Placed& b);

/// Distance of the cores (without the balls) of two convex bodies at rest, at `placed` or at the pose in
/// `exact`.
struct WideGap {
  Real3 direction;  // A to B: the direction along which to look for a lower bound
  Real above = 0;   // upper bound: the distance of two points of the cores
};
std::optional<WideGap> wide_gap(const Operand& a, const Operand& b);

}  // namespace touchstone::referee
