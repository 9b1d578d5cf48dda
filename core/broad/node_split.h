// Where a box is inserted in a tree, and how a full node is split: by surface area, because the number of
// random boxes that meet a node is about proportional to it (Goldsmith and Salmon 1987).
#pragma once

#include <cstdint>
#include <span>

#include "core/broad/float_key.h"

namespace touchstone::broad {

struct NodeEntry {
  KeyBox box;
  std::uint32_t code = 0;
};

/// How much a node's surface grows when a box is added; ties go to the smaller node. Infinite boxes compare
/// as equal: any choice is right.
struct Growth {
  double more = 0, surface = 0;
  bool operator<(const Growth& other) const {
    return more < other.more || (more == other.more && surface < other.surface);
  }
};
Growth growth(const KeyBox& node, const KeyBox& box);

/// Reorders the entries so that the first k become one node and the others the other, and returns k. Neither
/// node gets fewer than a quarter.
std::size_t split_node(std::span<NodeEntry> all);

inline bool inside(const KeyBox& box, const KeyBox& node) {
  bool in = true;
  for (int k = 0; k < 3; ++k) in &= box.lo[k] >= node.lo[k] && box.hi[k] <= node.hi[k];
  return in;
}

}  // namespace touchstone::broad
