// Sort and sweep (Baraff 1992, §"bounding boxes"), rebuilt for each query. The boxes are radix-sorted by
// their lower end on the axis on which their centres have the largest spread relative to their size (which
// leaves the least pruning to the other two axes). Each box is compared with those that begin before it ends,
// ties included; all three axes are tested. O(n log n + n + k), where k is the number of pairs that overlap
// on the sweep axis.
#pragma once

#include "core/broad/key_sort.h"
#include "core/broad/pair_kernels.h"
#include "core/broad/scene_stats.h"

namespace touchstone::broad {

class SortAndSweepFinder {
 public:
  void find(const BoxStore& store, PairSink& sink);
  void validate(const BoxStore& store) const;
  std::size_t memory_bytes() const {
    return columns_.memory_bytes() + (order_.capacity() + scratch_.capacity()) * sizeof(KeyedSlot);
  }
  std::string explain() const;
  Structure structure() const { return {axis_, {}, {}}; }

 private:
  RememberedStats stats_;
  int axis_ = 0;
  std::vector<KeyedSlot> order_, scratch_;
  BoxColumns columns_;
};

BroadPhasePtr make_sort_and_sweep(const Options& options = {});

}  // namespace touchstone::broad
