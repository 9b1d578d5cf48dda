// Building blocks of the plain competitors: a radix sort of float keys and a SIMD sweep of float boxes.
// Shares no code with core/broad on purpose, because the core is measured against it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/broad/broad_phase.h"

namespace touchstone::bench {

struct PlainItem {
  std::uint32_t key, box;
};

/// The bits of a float as an unsigned integer that sorts in the same order.
std::uint32_t plain_key(float f);

/// Three stable passes of 11 bits.
void plain_radix_sort(std::vector<PlainItem>& items, std::vector<PlainItem>& scratch);

/// Boxes by column: lo x y z, hi x y z; readable for 64 entries past n, whose lo x must exceed all others.
struct PlainColumns {
  std::array<std::vector<float>, 6> c;
  /// Box index; the two highest bits of a grid entry tell whether it is its box's first in y and in z.
  std::vector<std::uint32_t> code;
  void resize(std::size_t n);
  void put(std::size_t at, const Aabb& b, std::uint32_t with_code);
};

/// Pairs within [begin, end), which ascends in lo x, that this column owns: ORed, the two codes have both
/// highest bits set. Unsorted.
void plain_sweep_range(const PlainColumns& boxes, std::size_t begin, std::size_t end,
                       std::vector<broad::IdPair>& out, std::size_t& n);

}  // namespace touchstone::bench
