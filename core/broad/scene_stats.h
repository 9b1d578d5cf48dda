// Sizes and spread of a fixed sample of the boxes, used to choose a method. Only choices depend on these
// numbers, never a pair: any value is safe, even NaN and infinity.
#pragma once

#include <span>

#include "core/broad/box_store.h"

namespace touchstone::broad {

struct SceneStats {
  double median_size[3] = {};        // of the sampled boxes
  double spread[3] = {};             // standard deviation of the centres
  double low[3] = {}, high[3] = {};  // extent of the sample's centres without 1/64 at each end
  double density = 0;        // share of all boxes per unit of volume, around the average box
  double largest_ratio = 1;  // 99th percentile of the largest side over its median
};

/// Samples 256 boxes, or one in 64 of a large scene, at equal steps through the slots.
SceneStats sample_scene(const BoxStore& store);

/// The same for the boxes that `codes` name (in their low bits, pair_kernels.h).
SceneStats sample_boxes(const KeyBox* boxes, std::span<const std::uint32_t> codes);

/// Samples again every few queries, or when the number of boxes has doubled or halved.
class RememberedStats {
 public:
  const SceneStats& of(const BoxStore& store);

 private:
  SceneStats stats_;
  int age_ = 0;
  std::size_t present_ = 0;
};

/// The axis on which a sweep prunes most: the largest spread relative to the size of the boxes.
int best_axis(const SceneStats& stats);

}  // namespace touchstone::broad
