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

}  // namespace touchstone::broad
