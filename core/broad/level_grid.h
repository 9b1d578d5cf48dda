// One level of a grid: columns on two axes, cut into cells along the third. A box is filed in each column
// that it meets, in the cell of its lower end, and compared with the entries in the cells of that column that
// it reaches. Two overlapping boxes share the column of the larger of their lower cells on both axes. There,
// and only there, each owner flag is set in at least one of the two, so each pair is reported once.
//
// Filing is a counting sort by cell: no comparisons, no search. When the cells do not fit in a table of two
// to four places per box (clusters in a wide world), they are hashed into it: place = start of the column +
// w, modulo the size of the table. The cells of a column are thus still consecutive, and one wide comparison
// tests several cells. Teschner et al., Optimized Spatial Hashing (2003), with columns in place of cells.
#pragma once

#include <span>

#include "core/broad/grid_kernels.h"
#include "core/broad/scene_stats.h"

namespace touchstone::broad {

class LevelGrid {
 public:
  /// Files the boxes of `codes` (indices into `boxes`, with moving_flag) that are small enough for the cells.
  /// The others go to `too_large`, in order.
  void build(const KeyBox* boxes, const std::vector<std::uint32_t>& codes, const SceneStats& stats,
             std::vector<std::uint32_t>& too_large);
  /// Part `part` of `parts` of the pairs among the filed boxes.
  void self_pairs(Doubt doubt, std::size_t parts, std::size_t part, PairSink& sink) const;
  /// Pairs of a box that is not filed here with the filed boxes. `code` has no owner flags.
  void query(const KeyBox& box, std::uint32_t code, Doubt doubt, PairSink& sink) const;

  /// Keeps one entry per box, that of its lowest column, and releases the other memory. After that
  /// self_pairs() must not be called, and a query starts one column lower.
  void thin_out();

  std::size_t filed() const { return boxes_; }
  std::size_t entries() const { return count_; }
  std::size_t places() const { return places_; }
  bool hashed() const { return shape_.mask != 0xffffffff; }
  int axis() const { return shape_.axis_w; }
  Structure::Grid picture() const;
  double cell_size(int axis) const { return 1 / static_cast<double>(shape_.scale[axis]); }
  void validate() const;
  std::size_t memory_bytes() const;

 private:
  void choose_cells(const SceneStats& stats, std::size_t n);
  void scan_places(const KeyBox& box, std::uint32_t code, std::uint32_t column, std::uint32_t from,
                   std::uint32_t cells, Doubt doubt, PairSink& sink) const;
  GridShape shape_;
  std::size_t places_ = 0, ghosts_ = 0, count_ = 0, boxes_ = 0;
  bool thin_ = false;
  std::vector<std::uint32_t> begin_;  // first entry of each place; places, ghosts, end
  std::vector<GridEntry> entries_;  // count_, then copies of those of the first ghosts_ places, then padding
  std::vector<Filed> filed_;
};

}  // namespace touchstone::broad
