// Corners of the polygon that represents a round face in manifolds: 32, inscribed in the circle, covering
// 99.4 % of the disc's area.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace touchstone::narrow {

inline constexpr int rim_corners = 32;

/// On the unit circle, counter-clockwise from (1, 0); corners on the axes are exact.
inline const std::array<std::array<double, 2>, rim_corners>& rim() {
  static const auto corners = [] {
    std::array<std::array<double, 2>, rim_corners> c;
    constexpr std::size_t quarter = rim_corners / 4;
    for (std::size_t k = 0; k < rim_corners; ++k) {
      const double angle = 2 * std::numbers::pi / rim_corners * static_cast<double>(k);
      c[k] = k == 0        ? std::array{1.0, 0.0}
             : k < quarter ? std::array{std::cos(angle), std::sin(angle)}
                           : std::array{-c[k - quarter][1], c[k - quarter][0]};
    }
    return c;
  }();
  return corners;
}

}  // namespace touchstone::narrow
