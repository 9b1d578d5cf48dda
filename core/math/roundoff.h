// Constants of the arithmetics that answers are computed in. A unit roundoff is the largest relative error of
// a rounding to the nearest number, half the distance from 1 to the next one.
#pragma once

#include <limits>

namespace touchstone {

/// Relative to the number that is rounded.
inline constexpr double double_roundoff = 0x1p-53, float_roundoff = 0x1p-24;
static_assert(double_roundoff == std::numeric_limits<double>::epsilon() / 2);
static_assert(float_roundoff == double{std::numeric_limits<float>::epsilon()} / 2);

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace touchstone
