#include "core/broad/grid.h"

#include "core/broad/stored_phase.h"
#include "core/tolerance.h"

namespace touchstone::broad {

template <int max_levels>
void GridFinder<max_levels>::find(const BoxStore& store, PairSink& sink) {
  SceneStats stats = stats_.of(store);
  axis_ = best_axis(stats), used_ = 0;
  boxes_.clear();
  for (BoxStore::Slot s = 0; s < store.slots(); ++s)
    if (store.is_present(s)) boxes_.push_back({unsigned_key(store.keys()[s].lo[axis_]), s});
  sort_by_key(boxes_, scratch_);
  while (used_ < max_levels && boxes_.size() > tolerance::grid_least_boxes) {
    if (used_ > 0) stats = sample_scene(store, boxes_);
    if (levels_.size() == used_) levels_.emplace_back();
    levels_[used_].build(store, boxes_, axis_, stats, large_);
    // A level that takes less than half is not worth its queries.
    if (levels_[used_].entered() * 2 < boxes_.size()) break;
    levels_[used_++].self_pairs(sink);
    boxes_.swap(large_);
    for (const KeyedSlot& k : boxes_) levels_[used_ - 1].query(store, k.slot, sink);
  }
  sweep_rest(store, sink);
}

template <int max_levels>
void GridFinder<max_levels>::sweep_rest(const BoxStore& store, PairSink& sink) {
  rest_.resize(boxes_.size());
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    rest_.put(i, store.keys()[boxes_[i].slot], plain_code(store, boxes_[i].slot), axis_);
  sweep_range(rest_, 0, rest_.size, sink);
}

template <int max_levels>
void GridFinder<max_levels>::validate(const BoxStore&) const {
  for (std::size_t l = 0; l < used_; ++l) levels_[l].validate();
}

template <int max_levels>
std::size_t GridFinder<max_levels>::memory_bytes() const {
  std::size_t sum = (boxes_.capacity() + large_.capacity() + scratch_.capacity()) * sizeof(KeyedSlot) +
                    rest_.memory_bytes();
  for (const LevelGrid& l : levels_) sum += l.memory_bytes();
  return sum;
}

template <int max_levels>
std::string GridFinder<max_levels>::explain() const {
  std::string text = "columns along " + std::string(1, "xyz"[axis_]);
  for (std::size_t l = 0; l < used_; ++l)
    text += "; level " + std::to_string(l) + ": " + std::to_string(levels_[l].entered()) + " boxes, " +
            std::to_string(levels_[l].entries()) + " entries in " + std::to_string(levels_[l].cells()) +
            " columns " + std::to_string(levels_[l].cell_size(0)) + " wide";
  return text + "; swept: " + std::to_string(rest_.size);
}

template class GridFinder<1>;
template class GridFinder<6>;

BroadPhasePtr make_grid() { return std::make_unique<StoredPhase<UniformGridFinder>>(); }
BroadPhasePtr make_hierarchical_grid() { return std::make_unique<StoredPhase<HierarchicalGridFinder>>(); }

}  // namespace touchstone::broad
