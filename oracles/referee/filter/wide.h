// 237-bit binary floating point, about 71 decimal digits, with a wide exponent: for a search that extended
// precision cannot finish. No result found in it is relied on: the checker's rationals decide.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

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

}  // namespace touchstone::referee
