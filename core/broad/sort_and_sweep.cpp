#include "core/broad/sort_and_sweep.h"

#include "core/broad/stored_phase.h"

namespace touchstone::broad {

void SortAndSweepFinder::find(const BoxStore& store, PairSink& sink) {
  axis_ = best_axis(stats_.of(store));
  order_.clear();
  for (BoxStore::Slot s = 0; s < store.slots(); ++s)
    if (store.is_present(s)) order_.push_back({unsigned_key(store.keys()[s].lo[axis_]), s});
  sort_by_key(order_, scratch_);
  columns_.resize(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i)
    columns_.put(i, store.keys()[order_[i].slot], plain_code(store, order_[i].slot), axis_);
  sweep_all(columns_, sink);
}

void SortAndSweepFinder::validate(const BoxStore&) const {
  for (std::size_t i = 1; i < columns_.size; ++i)
    if (columns_.lo[0][i - 1] > columns_.lo[0][i]) throw std::logic_error("sort and sweep: out of order");
}

std::string SortAndSweepFinder::explain() const {
  return std::string("sort and sweep along ") + "xyz"[axis_];
}

BroadPhasePtr make_sort_and_sweep(const Options& options) {
  return std::make_unique<StoredPhase<SortAndSweepFinder>>(options);
}

}  // namespace touchstone::broad
