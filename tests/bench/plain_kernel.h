// What the plain competitors are made of: a radix sort of float keys and a wide sweep of float boxes. Shares
// no code with core/broad, on purpose: it is what the core is measured against.
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

/// The bits of a float as an unsigned number of the same order.
std::uint32_t plain_key(float f);

/// Three stable passes of 11 bits.
void plain_radix_sort(std::vector<PlainItem>& items, std::vector<PlainItem>& scratch);

/// Boxes in columns: lo x y z, hi x y z; readable for 64 entries beyond n, whose lo x must be beyond all.
struct PlainColumns {
  std::array<std::vector<float>, 6> c;
  /// Box index; the two highest bits of a grid's entry say whether it is the first of its box on y, on z.
  std::vector<std::uint32_t> code;
  void resize(std::size_t n);
  void put(std::size_t at, const Aabb& b, std::uint32_t with_code);
};

/// Pairs within [begin, end), ascending in lo x, that own the pair: the two codes' highest bits ORed are both
/// set. Unsorted.
void plain_sweep_range(const PlainColumns& boxes, std::size_t begin, std::size_t end,
                       std::vector<broad::IdPair>& out, std::size_t& n);

}  // namespace touchstone::bench
