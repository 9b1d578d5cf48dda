// Incremental sweep and prune: last frame's order and pairs are kept (Baraff 1992; Cohen et al. 1995,
// I-COLLIDE, without their linked lists). The order is repaired by insertion sort, O(n + inversions); a
// budget of moves a box bounds it, beyond which the boxes are radix-sorted: a teleport costs one full sort.
// When few boxes have changed, the kept pairs that touch none of them stand, and each changed box is compared
// with those in its reach only; otherwise the order is swept. One axis is kept, that of most spread when
// boxes last came or went.
#pragma once

#include "core/broad/key_sort.h"
#include "core/broad/pair_kernels.h"

namespace touchstone::broad {

class IncrementalSweepFinder {
 public:
  void find(const BoxStore& store, PairSink& sink);
  void validate(const BoxStore& store) const;
  std::size_t memory_bytes() const;
  std::string explain() const;
  Structure structure() const { return {axis_, {}, {}}; }

 private:
  void start_order(const BoxStore& store);
  void repair_order(const BoxStore& store);
  bool insertion_sort();
  void fill_columns(const BoxStore& store);
  void keep_untouched(PairSink& sink) const;
  void find_touched(const BoxStore& store, PairSink& sink);
  static constexpr std::uint64_t never = ~std::uint64_t{0};
  int axis_ = 0;
  double longest_ = 0;  // no box is longer along the axis
  std::uint64_t membership_ = never;
  std::vector<KeyedSlot> order_, scratch_;
  std::vector<std::uint32_t> position_;  // of a slot in the order
  std::vector<std::uint8_t> touched_;    // of a slot
  BoxColumns columns_;
  std::vector<SlotPair> kept_;  // of the last query, when few boxes had changed
  bool has_kept_ = false, local_ = false, full_sort_ = false;
};

BroadPhasePtr make_incremental_sweep(const Options& options = {});

}  // namespace touchstone::broad
