// Uniform grid, and hierarchical grid for uneven sizes.
//
// The grid's cells fit the usual box (level_grid.h). Boxes that are large for them make up the next level,
// whose grid has cells to their measure, and so on; each large box looks into the grids of all finer levels.
// The uniform grid has one level; its large boxes are swept. Ericson, Real-Time Collision Detection (2005),
// §7.2, with columns that are swept in place of cubic cells.
#pragma once

#include "core/broad/level_grid.h"

namespace touchstone::broad {

template <int max_levels>
class GridFinder {
 public:
  void find(const BoxStore& store, PairSink& sink);
  void validate(const BoxStore& store) const;
  std::size_t memory_bytes() const;
  std::string explain() const;

 private:
  void sweep_rest(const BoxStore& store, PairSink& sink);
  RememberedStats stats_;
  int axis_ = 0;
  std::size_t used_ = 0;
  std::vector<LevelGrid> levels_;
  std::vector<KeyedSlot> boxes_, large_, scratch_;
  BoxColumns rest_;
};

using UniformGridFinder = GridFinder<1>;
using HierarchicalGridFinder = GridFinder<6>;
extern template class GridFinder<1>;
extern template class GridFinder<6>;

BroadPhasePtr make_grid();
BroadPhasePtr make_hierarchical_grid();

}  // namespace touchstone::broad
