// Order along a Z-shaped curve (Morton 1966): neighbours in space are mostly neighbours in order.
#pragma once

#include <cstdint>

namespace touchstone::broad {

/// The lowest 10 bits of x, with two zeros between neighbouring bits.
inline std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

}  // namespace touchstone::broad
