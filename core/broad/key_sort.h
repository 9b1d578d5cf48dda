// Least-significant-digit radix sort of (key, value): stable, O(n) for each of three digits of 11 bits. A
// digit that is the same for all items is skipped.
#pragma once

#include <cstdint>
#include <vector>

namespace touchstone::broad {

struct KeyedSlot {
  std::uint32_t key = 0, slot = 0;
};

/// Maps a signed key to an unsigned key of the same order.
inline std::uint32_t unsigned_key(std::int32_t key) { return static_cast<std::uint32_t>(key) ^ 0x80000000U; }

/// Sorts `items` by key; `scratch` is overwritten.
void sort_by_key(std::vector<KeyedSlot>& items, std::vector<KeyedSlot>& scratch);

// Order along a Z-shaped curve (Morton 1966): neighbours in space are mostly neighbours in order.

/// The lowest 10 bits of x, with two zeros between neighbouring bits.
inline std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

}  // namespace touchstone::broad
