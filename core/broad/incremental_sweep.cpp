#include "core/broad/incremental_sweep.h"

#include <algorithm>

#include "core/broad/release.h"
#include "core/broad/scene_stats.h"
#include "core/broad/stored_phase.h"
#include "core/tolerance.h"

namespace touchstone::broad {

void IncrementalSweepFinder::start_order(const BoxStore& store) {
  axis_ = best_axis(sample_scene(store));
  order_.clear();
  for (BoxStore::Slot s = 0; s < store.slots(); ++s)
    if (store.is_present(s)) order_.push_back({unsigned_key(store.keys()[s].lo[axis_]), s});
  sort_by_key(order_, scratch_);
  full_sort_ = true;
}

// False when the budget is spent; the order is still a permutation then.
bool IncrementalSweepFinder::insertion_sort() {
  auto budget = static_cast<std::int64_t>(order_.size() * tolerance::sweep_moves_per_box);
  for (std::size_t i = 1; i < order_.size(); ++i) {
    const KeyedSlot moved = order_[i];
    std::size_t j = i;
    for (; j > 0 && order_[j - 1].key > moved.key && budget > 0; --j, --budget) order_[j] = order_[j - 1];
    order_[j] = moved;
    if (budget <= 0) return false;
  }
  return true;
}

void IncrementalSweepFinder::repair_order(const BoxStore& store) {
  for (const BoxStore::Slot s : store.touched())
    order_[position_[s]].key = unsigned_key(store.keys()[s].lo[axis_]);
  full_sort_ = !insertion_sort();
  if (full_sort_) sort_by_key(order_, scratch_);
}

void IncrementalSweepFinder::fill_columns(const BoxStore& store) {
  position_.resize(store.slots());
  columns_.resize(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    position_[order_[i].slot] = static_cast<std::uint32_t>(i);
    columns_.code[i] = plain_code(store, order_[i].slot);
  }
  columns_.gather(store, axis_);
  longest_ = 0;
  for (std::size_t i = 0; i < columns_.size; ++i)
    longest_ =
        std::max(longest_, static_cast<double>(value_of(columns_.hi[0][i])) - value_of(columns_.lo[0][i]));
}

void IncrementalSweepFinder::keep_untouched(PairSink& sink) const {
  sink.reserve(kept_.size());
  for (const SlotPair& p : kept_)
    if ((touched_[p.first] | touched_[p.second]) == 0) sink.add(p.first, p.second);
}

// The highest flag of a code means "not touched" here. Each box is compared with all boxes after it, but only
// with untouched boxes before it, so a pair of two touched boxes is found once, by the one that comes first.
void IncrementalSweepFinder::find_touched(const BoxStore& store, PairSink& sink) {
  constexpr std::uint32_t untouched = 0x80000000;
  for (const BoxStore::Slot s : store.touched()) columns_.code[position_[s]] &= ~untouched;
  BoxColumns probe;
  probe.resize(1);
  const auto& lo = columns_.lo[0];
  const auto end = lo.begin() + static_cast<std::ptrdiff_t>(columns_.size);
  for (const BoxStore::Slot s : store.touched()) {
    const std::size_t at = position_[s];
    const KeyBox& b = store.keys()[s];
    const std::int32_t from = earliest_start(b.lo[axis_], longest_);
    const auto self = lo.begin() + static_cast<std::ptrdiff_t>(at);
    const auto low = std::lower_bound(lo.begin(), self, from),
               high = std::upper_bound(self, end, b.hi[axis_]);
    probe.put(0, b, columns_.code[at], axis_);
    scan_range(probe, 0, columns_, static_cast<std::size_t>(low - lo.begin()), at, sink);
    probe.code[0] |= untouched;
    scan_range(probe, 0, columns_, at + 1, static_cast<std::size_t>(high - lo.begin()), sink);
  }
}

void IncrementalSweepFinder::find(const BoxStore& store, PairSink& sink) {
  const bool members = membership_ != store.membership();
  membership_ = store.membership();
  if (members)
    start_order(store);
  else
    repair_order(store);
  fill_columns(store);
  const bool few = store.touched().size() * tolerance::sweep_local_share < store.present();
  local_ = !members && few && has_kept_;
  if (local_) {
    touched_.resize(store.slots());
    for (const BoxStore::Slot s : store.touched()) touched_[s] = 1;
    keep_untouched(sink);
    find_touched(store, sink);
    for (const BoxStore::Slot s : store.touched()) touched_[s] = 0;
  } else {
    sweep_all(columns_, sink);
  }
  has_kept_ = few;
  if (!few) {
    release(kept_);
    return;
  }
  sink.decide_doubtful(store);
  kept_.resize(sink.n);
  for (std::size_t i = 0; i < sink.n; ++i) kept_[i] = {sink.first[i], sink.second[i]};
}

void IncrementalSweepFinder::validate(const BoxStore& store) const {
  for (std::size_t i = 1; i < columns_.size; ++i)
    if (columns_.lo[0][i - 1] > columns_.lo[0][i]) throw std::logic_error("incremental sweep: out of order");
  if (membership_ != store.membership()) return;
  if (order_.size() != store.present()) throw std::logic_error("incremental sweep: a box is lost");
  for (std::size_t i = 0; i < order_.size(); ++i)
    if (position_[order_[i].slot] != i) throw std::logic_error("incremental sweep: a position is wrong");
}

std::size_t IncrementalSweepFinder::memory_bytes() const {
  return columns_.memory_bytes() + (order_.capacity() + scratch_.capacity()) * sizeof(KeyedSlot) +
         position_.capacity() * sizeof(std::uint32_t) + touched_.capacity() +
         kept_.capacity() * sizeof(SlotPair);
}

std::string IncrementalSweepFinder::explain() const {
  return std::string("incremental sweep along ") + "xyz"[axis_] + ": order " +
         (full_sort_ ? "sorted from scratch" : "repaired") +
         (local_ ? ", changed boxes searched" : ", all boxes swept");
}

BroadPhasePtr make_incremental_sweep(const Options& options) {
  return std::make_unique<StoredPhase<IncrementalSweepFinder>>(options);
}

}  // namespace touchstone::broad
