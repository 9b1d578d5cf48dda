// Bounding-volume hierarchies: one tree of the fixed boxes, one of the moving ones (wide_tree.h). Pairs: the
// moving tree against itself and against the fixed tree; fixed boxes are never compared with each other.
//
// When few boxes have changed since the last query, the pairs kept from it that touch none of them stand;
// only these boxes are put in, taken out, refitted or put in elsewhere, and only they look for partners. When
// many have, those that came or went are put in and taken out, the moving tree is refitted as a whole, and
// all pairs are searched. A tree is built anew in three cases only: when so many of its boxes came or went at
// once that putting them in would cost more (tree_change_share); when a refit of the whole has made its
// leaves reach tree_decay times as far as after the last build; when single changes have made them reach
// tree_rot times as far.
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
  WideTree* home(const BoxStore& store, BoxStore::Slot s);
  WideTree* holder(BoxStore::Slot s);
  void leave(const BoxStore& store, BoxStore::Slot s);
  bool enter(const BoxStore& store, BoxStore::Slot s);
  void build(const BoxStore& store, WideTree& tree);
  void update_all(const BoxStore& store);
  void update_few(const BoxStore& store, PairSink& sink);
  WideTree moving_, fixed_;
  std::vector<SlotPair> kept_;         // of the last query, when few boxes had changed
  std::vector<std::uint8_t> touched_;  // of a slot; all 0 between queries
  bool has_kept_ = false, local_ = false;
  long builds_ = 0, refits_ = 0, came_ = 0, went_ = 0;
};

BroadPhasePtr make_bounding_volume_hierarchy(const Options& options = {});

}  // namespace touchstone::broad
