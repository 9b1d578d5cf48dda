// A tree of boxes with 16 children a node and no pointers: level 0 holds the boxes in the order of their
// centres along a Morton curve, entry i of level l + 1 is the union of entries 16i … 16i + 15 of level l. One
// wide comparison tests a box against all children of a node. Build: a radix sort and a pass; refit: a pass.
// (Order: Morton 1966; linear trees: Lauterbach et al. 2009.)
#pragma once

#include "core/broad/key_sort.h"
#include "core/broad/pair_kernels.h"
#include "core/broad/scene_stats.h"

namespace touchstone::broad {

class WideTree {
 public:
  static constexpr std::size_t width = 16;

  /// Over the boxes present that are fixed, or over those that are not.
  void build(const BoxStore& store, bool fixed, const SceneStats& stats);
  /// The boxes have moved; none has come or gone.
  void refit(const BoxStore& store);
  /// The same when only the box in slot `s`, which is in this tree, has moved.
  void refit_one(const BoxStore& store, BoxStore::Slot s);
  /// Sets or clears the mark of a box in this tree. Marks are set by build(); pairs count when one of the two
  /// boxes is marked.
  void mark(BoxStore::Slot s, bool on);
  /// Pairs of an unmarked box, of this tree or not, with the marked boxes of this tree.
  void marked_partners(const BoxStore& store, BoxStore::Slot s, PairSink& sink);
  void self_pairs(PairSink& sink) const;
  void pairs_with(const WideTree& other, PairSink& sink) const;

  std::size_t size() const { return levels_.empty() ? 0 : levels_[0].size; }
  /// Mean reach of the unions of 16 boxes, in units of that after the last build: how far the order has
  /// decayed.
  double decay() const { return built_reach_ > 0 ? reach() / built_reach_ : 1; }
  void validate() const;
  /// Adds the boxes of the nodes, by level, lowest first.
  void picture(std::vector<std::vector<Aabb>>& nodes) const;
  std::size_t memory_bytes() const;

 private:
  void unite();
  void unite_node(std::size_t level, std::size_t node);
  double reach() const;
  void self(std::size_t level, std::size_t a, PairSink& sink) const;
  void cross(std::size_t level, std::size_t a, const WideTree& other, std::size_t other_level, std::size_t b,
             PairSink& sink) const;
  void query(const BoxColumns& from, std::size_t box, std::size_t level, std::size_t b, PairSink& sink) const;
  std::size_t end_of(std::size_t level, std::size_t node) const {
    return std::min(levels_[level - 1].size, width * (node + 1));
  }
  std::vector<BoxColumns> levels_;
  std::vector<KeyedSlot> order_, scratch_;
  std::vector<std::uint32_t> position_;  // of a slot in level 0
  BoxColumns probe_;
  double built_reach_ = 0;
};

}  // namespace touchstone::broad
