// A tree of boxes with up to 16 children per node and all leaves at the same depth. The entries of a level
// are stored in groups of 16, in columns, so that one wide comparison tests a box against all children of a
// node. Level 0 holds the boxes; an entry of a higher level is the union of one group of the level below.
// Built by a radix sort of the centres along a Morton curve into full groups (Morton 1966; linear trees:
// Lauterbach et al. 2009).
//
// Insertion descends to the group whose surface grows least. A full group is split where the surfaces of its
// halves, weighted by their sizes, are least (Goldsmith and Salmon 1987; Guttman's R-tree 1984 and Beckmann
// et al. 1990 for nodes with many children). Removal moves the last box of the group into the gap; when few
// boxes are left in a group, they are reinserted elsewhere. A box that moves out of its group's box is
// removed and reinserted. All of this is O(log n) per box and leaves the rest of the tree unchanged.
#pragma once

#include "core/broad/key_sort.h"
#include "core/broad/pair_kernels.h"
#include "core/broad/scene_stats.h"

namespace touchstone::broad {

class WideTree {
 public:
  static constexpr std::size_t width = 16;

  /// Builds over the present boxes that are fixed, or over those that are not.
  void build(const BoxStore& store, bool fixed, const SceneStats& stats);
  bool holds(BoxStore::Slot s) const { return s < position_.size() && position_[s] != nowhere; }
  /// Inserts a box that this tree does not hold.
  void insert(const BoxStore& store, BoxStore::Slot s);
  /// Removes a slot that this tree holds; its box may already have been removed from the store.
  void remove(BoxStore::Slot s);
  /// Updates the tree after its boxes have moved.
  void refit(const BoxStore& store);
  /// The same when only the box in slot `s`, which this tree holds, has moved.
  void refit_one(const BoxStore& store, BoxStore::Slot s);
  /// Sets or clears the mark of a box in this tree. build() and insert() set marks; pairs count when one of
  /// the two boxes is marked.
  void mark(BoxStore::Slot s, bool on);
  /// Pairs of an unmarked box, in this tree or not, with the marked boxes of this tree.
  void marked_partners(const BoxStore& store, BoxStore::Slot s, PairSink& sink);
  /// In parallel according to the sink's options.
  void self_pairs(PairSink& sink) const;
  void pairs_with(const WideTree& other, PairSink& sink) const;

  std::size_t size() const { return boxes_; }
  /// Size of the leaves per box, relative to that after the last build: how much more expensive a search has
  /// become.
  double decay() const { return built_cost_ > 0 ? cost() / built_cost_ : 1; }
  void validate() const;
  /// Adds the boxes of the nodes by level, lowest level first.
  void picture(std::vector<std::vector<Aabb>>& nodes) const;
  std::size_t memory_bytes() const;

 private:
  static constexpr std::uint32_t nowhere = 0xffffffff;
  struct Level {
    BoxColumns entries;  // by group; code on level 0: see pair_kernels.h; above: the group below
    std::vector<std::uint32_t> parent;  // by group: entry of the level above
    std::vector<std::uint8_t> used;     // by group: number of entries in use, at its front; 0: the group is free
    std::vector<std::uint32_t> free;
  };
  // Deals tasks to parts in turn.
  struct Turn {
    std::size_t parts = 1, part = 0, task_level = 0, next = 0;
    bool mine() { return parts == 1 || next++ % parts == part; }
  };
  std::size_t top() const { return levels_.size() - 1; }
  // Tasks are the groups of the task level, and the pairs of neighbours above it.
  Turn turn_of(std::size_t parts, std::size_t part) const {
    return {parts, part, top() > 3 ? std::size_t{2} : top() / 2, 0};
  }
  std::size_t child(std::size_t level, std::size_t entry) const {
    return levels_[level].entries.code[entry] * width;
  }
  std::size_t end_of(std::size_t level, std::size_t group) const {
    return group * width + levels_[level].used[group];
  }
  std::uint32_t add_group(std::size_t level);
  void add_root();
  void link(std::size_t level, std::size_t entry);
  void put(std::size_t level, std::size_t entry, const KeyBox& box, std::uint32_t code);
  void add(std::size_t level, std::size_t group, const KeyBox& box, std::uint32_t code);
  void split(std::size_t level, std::size_t group, const KeyBox& box, std::uint32_t code);
  void take_out(std::size_t level, std::size_t entry);
  void dissolve(std::size_t group);
  void add_box(const KeyBox& box, std::uint32_t code);
  KeyBox box_of(std::size_t level, std::size_t entry) const;
  KeyBox union_of(std::size_t level, std::size_t group) const;
  void unite_above(std::size_t level, std::size_t group);
  double cost() const;
  void self(std::size_t level, std::size_t group, Turn& turn, PairSink& sink) const;
  void cross(std::size_t level, std::size_t a, const WideTree& other, std::size_t other_level, std::size_t b,
             PairSink& sink) const;
  void query(const BoxColumns& from, std::size_t box, std::size_t level, std::size_t b, PairSink& sink) const;
  std::vector<Level> levels_;            // the last level has one group, 0
  std::vector<std::uint32_t> position_;  // by slot: entry of level 0, or nowhere
  BoxColumns probe_;
  std::size_t boxes_ = 0;
  double built_cost_ = 0;
};

}  // namespace touchstone::broad
