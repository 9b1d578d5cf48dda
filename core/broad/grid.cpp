#include "core/broad/grid.h"

#include "core/broad/release.h"
#include "core/broad/stored_phase.h"
#include "core/tolerance.h"

namespace touchstone::broad {

void GridLevels::build(const KeyBox* boxes, std::vector<std::uint32_t>& codes, const SceneStats& stats,
                       std::size_t max_levels) {
  used_ = 0;
  levels_.reserve(max_levels);  // the rest of one level is read while the next is added
  const std::vector<std::uint32_t>* left = &codes;
  while (used_ < max_levels && left->size() > tolerance::grid_min_boxes) {
    if (levels_.size() == used_) levels_.emplace_back();
    Level& level = levels_[used_];
    level.grid.build(boxes, *left, used_ > 0 ? sample_boxes(boxes, *left) : stats, level.too_large);
    // A level that takes fewer than half of the boxes is not worth its queries.
    if (level.grid.filed() * 2 < left->size()) break;
    left = &level.too_large;
    ++used_;
  }
  sort_rest(boxes, *left);
}

void GridLevels::sort_rest(const KeyBox* boxes, const std::vector<std::uint32_t>& codes) {
  order_.clear();
  for (const std::uint32_t c : codes)
    order_.push_back({unsigned_key(boxes[c & slot_mask].lo[0]), c | owner_flags});
  sort_by_key(order_, scratch_);
  rest_.resize(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i)
    rest_.put(i, boxes[order_[i].slot & slot_mask], order_[i].slot, 0);
}

void GridLevels::pairs(const KeyBox* boxes, Doubt doubt, PairSink& sink) {
  std::size_t work = 0;
  for (std::size_t l = 0; l < used_; ++l) work += levels_[l].grid.entries() + 4 * levels_[l].too_large.size();
  const std::size_t parts = sink.parts(work);
  sink.in_parts(parts, [&](std::size_t p, PairSink& out) {
    for (std::size_t l = 0; l < used_; ++l) {
      levels_[l].grid.self_pairs(doubt, parts, p, out);
      const std::vector<std::uint32_t>& large = levels_[l].too_large;
      deal_chunks(large.size(), 16, parts, p, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          levels_[l].grid.query(boxes[large[i] & slot_mask], large[i], doubt, out);
      });
    }
  });
  sweep_all(rest_, sink);
  if (doubt == Doubt::report) sink.accept_doubtful();
}

void GridLevels::thin_out() {
  for (std::size_t l = 0; l < used_; ++l) levels_[l].grid.thin_out();
  release(order_);
  release(scratch_);
}

void GridLevels::query(const KeyBox& box, std::uint32_t code, PairSink& sink) {
  for (std::size_t l = 0; l < used_; ++l) levels_[l].grid.query(box, code, Doubt::report, sink);
  probe_.resize(1);
  probe_.put(0, box, code | owner_flags, 0);
  scan_range(probe_, 0, rest_, 0, rest_.size, sink);
  sink.accept_doubtful();
}

void GridLevels::validate() const {
  for (std::size_t l = 0; l < used_; ++l) levels_[l].grid.validate();
  for (std::size_t i = 1; i < rest_.size; ++i)
    if (rest_.lo[0][i - 1] > rest_.lo[0][i]) throw std::logic_error("grid: the rest is out of order");
}

std::size_t GridLevels::memory_bytes() const {
  std::size_t sum = (order_.capacity() + scratch_.capacity()) * sizeof(KeyedSlot) + rest_.memory_bytes() +
                    probe_.memory_bytes();
  for (const Level& l : levels_)
    sum += l.grid.memory_bytes() + l.too_large.capacity() * sizeof(std::uint32_t);
  return sum;
}

std::string GridLevels::explain() const {
  std::string text = "grid";
  for (std::size_t l = 0; l < used_; ++l) {
    const LevelGrid& g = levels_[l].grid;
    const int u = (g.axis() + 1) % 3;
    text += "; level " + std::to_string(l) + ": " + std::to_string(g.filed()) + " boxes, " +
            std::to_string(g.entries()) + " entries in " + std::to_string(g.places()) +
            (g.hashed() ? " hashed" : "") + " places, columns along " + std::string(1, "xyz"[g.axis()]) +
            " " + std::to_string(g.cell_size(u)) + " wide";
  }
  return text + "; swept: " + std::to_string(rest_.size);
}

Structure GridLevels::structure() const {
  Structure s;
  for (std::size_t l = 0; l < used_; ++l) s.grids.push_back(levels_[l].grid.picture());
  if (rest_.size > 0) s.sweep_axis = 0;
  return s;
}

template <int max_levels>
void GridFinder<max_levels>::find(const BoxStore& store, PairSink& sink) {
  store.codes(codes_);
  levels_.build(store.keys().data(), codes_, stats_.of(store), max_levels);
  levels_.pairs(store.keys().data(), Doubt::decide, sink);
}

template class GridFinder<1>;
template class GridFinder<6>;

BroadPhasePtr make_grid(const Options& options) {
  return std::make_unique<StoredPhase<UniformGridFinder>>(options);
}
BroadPhasePtr make_hierarchical_grid(const Options& options) {
  return std::make_unique<StoredPhase<HierarchicalGridFinder>>(options);
}

}  // namespace touchstone::broad
