// Where a box goes in a tree, and how a full node is divided: by surface, which the number of random boxes
// that meet a node is about proportional to (Goldsmith and Salmon 1987).
#pragma once

#include <cstdint>
#include <span>

#include "core/broad/float_key.h"

namespace touchstone::broad {

struct NodeEntry {
  KeyBox box;
  std::uint32_t code = 0;
};

/// How much a node's surface grows by taking a box; the smaller node first where that is equal. Infinite
/// boxes compare as equal: any choice is right.
struct Growth {
  double more = 0, surface = 0;
  bool operator<(const Growth& other) const {
    return more < other.more || (more == other.more && surface < other.surface);
  }
};
Growth growth(const KeyBox& node, const KeyBox& box);

/// Puts the entries in an order in which the first k, the result, are one node, the others the other; neither
/// has fewer than a quarter.
std::size_t split_node(std::span<NodeEntry> all);

inline bool inside(const KeyBox& box, const KeyBox& node) {
  bool in = true;
  for (int k = 0; k < 3; ++k) in &= box.lo[k] >= node.lo[k] && box.hi[k] <= node.hi[k];
  return in;
}

}  // namespace touchstone::broad
