#pragma once

#include <limits>

namespace touchstone {

/// Largest relative error of one rounding to nearest in the arithmetic R: 2⁻⁵³ for double, 2⁻²⁴ for float.
template <class R>
inline constexpr R unit_roundoff = std::numeric_limits<R>::epsilon() / 2;

}  // namespace touchstone
