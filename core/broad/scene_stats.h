// What a method is chosen by: sizes and spread of a fixed sample of the boxes. Only choices hang on these
// numbers, never a pair: any value, NaN and infinity too, is safe.
#pragma once

#include <span>

#include "core/broad/box_store.h"

namespace touchstone::broad {

struct SceneStats {
  double median_size[3] = {};        // of the sample
  double spread[3] = {};             // standard deviation of the centres
  double low[3] = {}, high[3] = {};  // extent of the sample's centres without 1/64 at each end
  double density = 0;        // share of the boxes a unit of volume, as the average box sees it around itself
  double largest_ratio = 1;  // 99th percentile of the largest side over its median
};

/// 256 boxes, of a large scene one in 64, at equal steps through the slots.
SceneStats sample_scene(const BoxStore& store);

/// The same of the boxes that `codes` name (their low bits, pair_kernels.h).
SceneStats sample_boxes(const KeyBox* boxes, std::span<const std::uint32_t> codes);

/// Samples anew every few queries, or when the number of boxes has doubled or halved.
class RememberedStats {
 public:
  const SceneStats& of(const BoxStore& store);

 private:
  SceneStats stats_;
  int age_ = 0;
  std::size_t present_ = 0;
};

/// The axis on which a sweep prunes most: most spread for the size of its boxes.
int best_axis(const SceneStats& stats);

}  // namespace touchstone::broad
