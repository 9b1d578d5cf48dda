// Uniform grid, and hierarchical grid for boxes of different sizes.
//
// The cells of a grid fit the typical box (level_grid.h). Boxes that are too large for them form the next
// level, whose cells fit those boxes, and so on; each large box is queried against the grids of all finer
// levels. The uniform grid has one level, and its large boxes are swept. Ericson, Real-Time Collision
// Detection (2005), §7.2, with columns in place of cubic cells.
#pragma once

#include "core/broad/key_sort.h"
#include "core/broad/level_grid.h"

namespace touchstone::broad {

/// The levels of a grid over boxes that the caller owns.
class GridLevels {
 public:
  /// Builds over the boxes of `codes` (indices with moving_flag).
  void build(const KeyBox* boxes, std::vector<std::uint32_t>& codes, const SceneStats& stats,
             std::size_t max_levels);
  /// All pairs. `boxes` must be those of build().
  void pairs(const KeyBox* boxes, Doubt doubt, PairSink& sink);
  /// Pairs of another box with the boxes of build().
  void query(const KeyBox& box, std::uint32_t code, PairSink& sink);
  /// Keeps only what query() needs.
  void thin_out();
  /// Releases all memory.
  void forget() { *this = {}; }
  std::size_t swept() const { return rest_.size; }
  void validate() const;
  std::size_t memory_bytes() const;
  std::string explain() const;
  Structure structure() const;

 private:
  void sort_rest(const KeyBox* boxes, const std::vector<std::uint32_t>& codes);
  struct Level {
    LevelGrid grid;
    std::vector<std::uint32_t> too_large;
  };
  std::vector<Level> levels_;
  std::size_t used_ = 0;
  std::vector<KeyedSlot> order_, scratch_;
  BoxColumns rest_, probe_;  // boxes that no level holds, sorted along x
};

template <int max_levels>
class GridFinder {
 public:
  void find(const BoxStore& store, PairSink& sink);
  void validate(const BoxStore&) const { levels_.validate(); }
  std::size_t memory_bytes() const {
    return levels_.memory_bytes() + codes_.capacity() * sizeof(std::uint32_t);
  }
  std::string explain() const { return levels_.explain(); }
  Structure structure() const { return levels_.structure(); }

 private:
  RememberedStats stats_;
  std::vector<std::uint32_t> codes_;
  GridLevels levels_;
};

using UniformGridFinder = GridFinder<1>;
using HierarchicalGridFinder = GridFinder<6>;
extern template class GridFinder<1>;
extern template class GridFinder<6>;

BroadPhasePtr make_grid(const Options& options = {});
BroadPhasePtr make_hierarchical_grid(const Options& options = {});

}  // namespace touchstone::broad
