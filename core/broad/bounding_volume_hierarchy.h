// Bounding-volume hierarchies: one tree of the fixed boxes, one of the moving boxes (wide_tree.h). Pairs come
// from the moving tree against itself and against the fixed tree; fixed boxes are never compared with each
// other.
//
// When few boxes have changed since the last query, the pairs kept from it that involve none of them remain
// valid; only the changed boxes are inserted, removed, refitted or reinserted, and only they are searched for
// partners. When many have changed, boxes are inserted and removed, the whole moving tree is refitted, and
// all pairs are searched. A tree is rebuilt in three cases only: when so many of its boxes are inserted or
// removed at once that single insertions would cost more (tree_change_share); when a full refit has made its
// leaves tree_decay times as large as after the last build; when single changes have made them
// tree_local_decay times as large.
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
    moving_.picture(s.nodes);
    fixed_.picture(s.nodes);
    return s;
  }

 private:
  WideTree* home(const BoxStore& store, BoxStore::Slot s);
  WideTree* holder(BoxStore::Slot s);
  void leave(const BoxStore& store, BoxStore::Slot s);
  bool enter(const BoxStore& store, BoxStore::Slot s);
  void build(const BoxStore& store, WideTree& tree);
  void update_all(const BoxStore& store);
  void update_few(const BoxStore& store, PairSink& sink);
  WideTree moving_, fixed_;
  std::vector<SlotPair> kept_;         // pairs of the last query, when few boxes had changed
  std::vector<std::uint8_t> touched_;  // by slot; all 0 between queries
  bool has_kept_ = false, local_ = false;
  long builds_ = 0, refits_ = 0, came_ = 0, went_ = 0;
};

BroadPhasePtr make_bounding_volume_hierarchy(const Options& options = {});

}  // namespace touchstone::broad
