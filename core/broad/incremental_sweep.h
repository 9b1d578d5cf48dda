// Incremental sweep and prune: keeps the order and pairs of the last query (Baraff 1992; Cohen et al. 1995,
// I-COLLIDE, without their linked lists). The order is repaired by insertion sort, O(n + inversions), within
// a budget of moves per box; when that is exceeded, the boxes are radix-sorted, so a teleport costs one full
// sort. When few boxes have changed, the kept pairs that involve none of them remain valid, and each changed
// box is compared only with the boxes in its reach; otherwise the whole order is swept. One axis is sorted:
// the one with the largest spread when a box was last inserted or removed.
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
  std::vector<std::uint32_t> position_;  // in the order, by slot
  std::vector<std::uint8_t> touched_;    // by slot
  BoxColumns columns_;
  std::vector<SlotPair> kept_;  // pairs of the last query, when few boxes had changed
  bool has_kept_ = false, local_ = false, full_sort_ = false;
};

BroadPhasePtr make_incremental_sweep(const Options& options = {});

}  // namespace touchstone::broad
