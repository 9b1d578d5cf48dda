// Bounding-volume hierarchies: one tree of the fixed boxes, one of the moving ones (wide_tree.h). Pairs: the
// moving tree against itself and against the fixed tree; fixed boxes are never compared with each other. A
// tree is refitted when boxes move and built anew when boxes come or go or its order has decayed; the fixed
// tree is left alone while no fixed box changes. When few boxes have changed since the last query, the pairs
// kept from it that touch none of them stand; only the paths above the changed boxes are refitted, and only
// these boxes look for partners.
#pragma once

#include "core/broad/wide_tree.h"

namespace touchstone::broad {

class HierarchyFinder {
 public:
  void find(const BoxStore& store, PairSink& sink);
  void validate(const BoxStore& store) const;
  std::size_t memory_bytes() const {
    return moving_.memory_bytes() + fixed_.memory_bytes() + touched_.capacity() +
           kept_.capacity() * sizeof(SlotPair);
  }
  std::string explain() const;
  Structure structure() const {
    Structure s;
    moving_.picture(s.nodes), fixed_.picture(s.nodes);
    return s;
  }

 private:
  void update(const BoxStore& store);
  void update_few(const BoxStore& store, PairSink& sink);
  static constexpr std::uint64_t never = ~std::uint64_t{0};
  WideTree moving_, fixed_;
  std::uint64_t membership_ = never, fixed_changes_ = never;
  std::vector<SlotPair> kept_;         // of the last query, when few boxes had changed
  std::vector<std::uint8_t> touched_;  // of a slot; all 0 between queries
  bool has_kept_ = false, local_ = false;
  long builds_ = 0, refits_ = 0;
};

BroadPhasePtr make_bounding_volume_hierarchy(const Options& options = {});

}  // namespace touchstone::broad
