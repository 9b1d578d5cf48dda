#include "core/broad/neighbour_list.h"

#include <algorithm>

#include "core/broad/list_kernels.h"
#include "core/broad/release.h"
#include "core/broad/stored_phase.h"
#include "core/tolerance.h"

namespace touchstone::broad {
namespace {

constexpr std::size_t levels = 6;
constexpr std::int32_t infinite = 0x7f800000;  // key of infinity

bool key_overlap(const KeyBox& a, const KeyBox& b) {
  bool apart = false;
  for (int k = 0; k < 3; ++k) apart |= a.lo[k] > b.hi[k] || b.lo[k] > a.hi[k];
  return !apart;
}

float largest_side(const KeyBox& b) {
  float most = 0;
  for (int k = 0; k < 3; ++k) most = std::max(most, value_of(b.hi[k]) - value_of(b.lo[k]));
  return most;
}

// The amount by which a box is widened. A box that moves far for its size would have a fat box full of others
// and would still leave it soon, so it gets no margin.
float margin(float step, float side) {
  const float m = static_cast<float>(tolerance::neighbour_margin_steps) * step;
  return m <= static_cast<float>(tolerance::neighbour_max_margin) * side ? m : 0;
}

std::uint32_t code_of(BoxStore::Slot s, const KeyBox& fat) { return s | (fat.hi[3] != 0 ? 0 : moving_flag); }

bool in_order(const SlotPair& a, const SlotPair& b) {
  return a.first < b.first || (a.first == b.first && a.second < b.second);
}

}  // namespace

void NeighbourListFinder::make_fat(const BoxStore& store, BoxStore::Slot s, KeyBox& fat) const {
  const KeyBox& key = store.keys()[s];
  const float m = margin(store.last_step(s), largest_side(key));
  for (int k = 0; k < 3; ++k) {
    // One key more, because the sum is rounded; never smaller than the box, never beyond infinity.
    const std::int32_t lo = std::max(key_of(value_of(key.lo[k]) - m) - 1, -infinite),
                       hi = std::min(key_of(value_of(key.hi[k]) + m) + 1, infinite);
    fat.lo[k] = m > 0 ? std::min(key.lo[k], lo) : key.lo[k];
    fat.hi[k] = m > 0 ? std::max(key.hi[k], hi) : key.hi[k];
  }
  fat.hi[3] = store.is_fixed(s) ? 1 : 0;
}

// Decided by a sample. A box that was just inserted has made no step yet: a scene of such boxes is not known
// to be coherent.
bool NeighbourListFinder::is_coherent(const BoxStore& store) {
  const std::uint64_t changes = store.membership() - membership_;
  membership_ = store.membership();
  if (changes * tolerance::neighbour_loose_share > store.present()) return false;
  std::size_t fast = 0, seen = 0;
  const std::size_t step = std::max<std::size_t>(1, store.slots() / 256);
  for (std::size_t i = 0; i < store.slots(); i += step) {
    const auto s = static_cast<BoxStore::Slot>(i);
    if (!store.is_present(s)) continue;
    ++seen;
    const float last = store.last_step(s);
    fast += last > 0 && margin(last, largest_side(store.keys()[s])) == 0 ? 1 : 0;
  }
  return fast * tolerance::neighbour_loose_share <= seen;
}

void NeighbourListFinder::build(const BoxStore& store, PairSink& sink) {
  loose_.clear();
  filed_as_.clear();
  with_filed_.clear();
  loose_candidates_.clear();
  store.codes(codes_);
  fat_.resize(store.slots());
  for (std::size_t s = 0; s < fat_.size(); ++s) fat_[s].lo[3] = 0;
  if (codes_.size() < fat_.size()) std::fill(fat_.begin(), fat_.end(), KeyBox{});
  for (const std::uint32_t c : codes_) make_fat(store, c & slot_mask, fat_[c & slot_mask]);
  sink.clear();
  levels_.build(fat_.data(), codes_, stats_.of(store), levels);
  // The sink's memory was released when the last list was built: reserve it at once, not step by step.
  sink.reserve(std::max(candidates_ + candidates_ / 32, codes_.size()));
  levels_.pairs(fat_.data(), Doubt::report, sink);
  sink.group(store.slots(), end_, codes_);
  candidates_ = sink.n;
  if (second_.size() < candidates_ + list_padding) {
    release(second_);
    second_.resize(candidates_ + candidates_ / 32 + list_padding);
  }
  const std::size_t parts = sink.parts(candidates_);
  run_parts(parts, [&](std::size_t p) {
    sort_buckets(end_.data(), part_begin(end_.size(), parts, p), part_begin(end_.size(), parts, p + 1),
                 codes_.data(), second_.data());
  });
  std::fill_n(second_.begin() + static_cast<std::ptrdiff_t>(candidates_), list_padding, 0);
  sink.release_memory();
  release(codes_);
  levels_.thin_out();
  alive_ = true;
  age_ = 0;
  work_ = 0;
  ++lists_;
}

const KeyBox& NeighbourListFinder::built_box(BoxStore::Slot s) const {
  const auto number = static_cast<std::size_t>(fat_[s].lo[3]);
  return number > 0 ? filed_as_[number - 1] : fat_[s];
}

bool NeighbourListFinder::is_listed(BoxStore::Slot a, BoxStore::Slot b) const {
  const KeyBox &p = built_box(a), &q = built_box(b);
  return (p.hi[3] & q.hi[3]) == 0 && key_overlap(p, q);
}

// Gives escaped boxes new fat boxes and finds their candidates among the boxes that are still filed under
// theirs.
void NeighbourListFinder::loosen(const BoxStore& store, PairSink& sink) {
  for (const BoxStore::Slot s : escaped_) {
    if (fat_[s].lo[3] == 0) {
      filed_as_.push_back(fat_[s]);
      loose_.push_back(s);
      fat_[s].lo[3] = static_cast<std::int32_t>(loose_.size());
    }
    make_fat(store, s, fat_[s]);
    fat_[s].lo[3] = -fat_[s].lo[3];  // until the end of this function: has just escaped
  }
  std::erase_if(with_filed_, [this](const SlotPair& p) {
    return fat_[p.first].lo[3] < 0 || fat_[p.second].lo[3] < 0 ||
           (fat_[p.first].lo[3] > 0 && fat_[p.second].lo[3] > 0);
  });
  for (const BoxStore::Slot s : escaped_) {
    const KeyBox& filed_as = filed_as_[static_cast<std::size_t>(-fat_[s].lo[3]) - 1];
    sink.clear();
    levels_.query(fat_[s], code_of(s, fat_[s]), sink);
    for (std::size_t i = 0; i < sink.n; ++i) {
      const BoxStore::Slot other = sink.first[i] == s ? sink.second[i] : sink.first[i];
      const bool listed = (filed_as.hi[3] & fat_[other].hi[3]) == 0 && key_overlap(filed_as, fat_[other]);
      if (other != s && fat_[other].lo[3] == 0 && !listed)
        with_filed_.push_back({sink.first[i], sink.second[i]});
    }
  }
  for (const BoxStore::Slot s : escaped_) fat_[s].lo[3] = -fat_[s].lo[3];
  find_loose_pairs(sink);
}

// Finds the candidates of two loose boxes that are not listed, then sorts all candidates with a loose box.
void NeighbourListFinder::find_loose_pairs(PairSink& sink) {
  codes_.clear();
  for (const BoxStore::Slot s : loose_) codes_.push_back(code_of(s, fat_[s]));
  sink.clear();
  loose_levels_.build(fat_.data(), codes_, sample_boxes(fat_.data(), codes_), levels);
  loose_levels_.pairs(fat_.data(), Doubt::report, sink);
  loose_candidates_ = with_filed_;
  for (std::size_t i = 0; i < sink.n; ++i)
    if (!is_listed(sink.first[i], sink.second[i]))
      loose_candidates_.push_back({sink.first[i], sink.second[i]});
  std::sort(loose_candidates_.begin(), loose_candidates_.end(), in_order);
  if (loose_levels_.memory_bytes() > little_memory) loose_levels_.forget();
  sink.release_memory();
}

// Returns false when the list is no longer worth keeping.
bool NeighbourListFinder::keep(const BoxStore& store, PairSink& sink) {
  const std::size_t built = fat_.size();
  if (built < store.slots()) fat_.resize(store.slots());
  escaped_.clear();
  find_escapes(store.keys().data(), fat_.data(), store.touched(), escaped_);
  // A loose box costs about as much per query as a box costs when the list is built; a box that escapes costs
  // several times that.
  work_ += loose_.size() + 4 * escaped_.size();
  if (work_ > store.present() || escaped_.size() * tolerance::neighbour_loose_share > store.present())
    return false;
  // The list omits pairs of boxes that were fixed when it was built.
  for (const BoxStore::Slot s : store.touched())
    if (store.is_present(s) && s < built && (fat_[s].hi[3] != 0) != store.is_fixed(s)) return false;
  if (!escaped_.empty()) loosen(store, sink);
  ++age_;
  return true;
}

// The index of the first loose candidate whose first slot is not below `slot`.
std::size_t NeighbourListFinder::loose_before(std::size_t slot) const {
  const auto at = std::partition_point(loose_candidates_.begin(), loose_candidates_.end(),
                                       [&](const SlotPair& p) { return p.first < slot; });
  return static_cast<std::size_t>(at - loose_candidates_.begin());
}

// Writes the pairs whose first slot is in [begin, end) and returns their number. `out` has room for all their
// candidates.
std::size_t NeighbourListFinder::report_range(const BoxStore& store, std::size_t begin, std::size_t end,
                                              IdPair* out) const {
  const auto decided = [&](const SlotPair& p) {
    return key_overlap(store.keys()[p.first], store.keys()[p.second]) &&
           overlaps(store.boxes()[p.first], store.boxes()[p.second]);
  };
  std::size_t n = 0, from = begin;
  const auto run_to = [&](std::size_t to) {
    to = std::min(to, end_.size());
    if (to > from)
      n += filter_candidates(store.keys().data(), store.boxes().data(), end_.data(), second_.data(), from, to,
                             out + n);
    from = std::max(from, to);
  };
  for (std::size_t i = loose_before(begin), last = loose_before(end); i < last;) {
    const std::uint32_t s = loose_candidates_[i].first;
    run_to(s);
    const std::size_t before = n;
    run_to(std::size_t{s} + 1);
    const std::size_t middle = n;
    for (; i < last && loose_candidates_[i].first == s; ++i)
      if (decided(loose_candidates_[i]))
        out[n++] = {static_cast<int>(s), static_cast<int>(loose_candidates_[i].second)};
    if (middle > before && n > middle) std::inplace_merge(out + before, out + middle, out + n);
  }
  run_to(end);
  return n;
}

// Each part writes to where its candidates would be if all of them were pairs.
void NeighbourListFinder::report(const BoxStore& store, const PairSink& sink,
                                 std::vector<IdPair>& out) const {
  out.resize(candidates_ + loose_candidates_.size());
  const std::size_t parts = sink.parts(out.size()), slots = store.slots();
  std::vector<std::size_t> begin(parts), count(parts);
  run_parts(parts, [&](std::size_t p) {
    const std::size_t from = part_begin(slots, parts, p), to = part_begin(slots, parts, p + 1);
    const std::size_t listed = std::min(from, end_.size());
    begin[p] = (listed > 0 ? end_[listed - 1] : 0) + loose_before(from);
    count[p] = report_range(store, from, to, out.data() + begin[p]);
  });
  std::size_t n = count[0];
  for (std::size_t p = 1; p < parts; n += count[p], ++p)
    std::copy_n(out.begin() + static_cast<std::ptrdiff_t>(begin[p]), count[p],
                out.begin() + static_cast<std::ptrdiff_t>(n));
  out.resize(n);
}

bool NeighbourListFinder::keep_up(const BoxStore& store, PairSink& sink, std::vector<IdPair>& out) {
  answered_ = false;
  if (alive_ && !keep(store, sink)) {
    // A list that did not last three queries has cost more than it saved: wait before the next one, longer
    // each time.
    patience_ = age_ < 3 ? std::min(2 * patience_ + 2, 64) : 0;
    wait_ = patience_;
    alive_ = false;
  }
  if (!alive_) {
    const bool coherent = is_coherent(store);
    if (wait_ > 0 || !coherent) {
      wait_ -= wait_ > 0 ? 1 : 0;
      return false;
    }
    build(store, sink);
  }
  answered_ = true;
  membership_ = store.membership();
  report(store, sink, out);
  return true;
}

void NeighbourListFinder::search(const BoxStore& store, PairSink& sink) {
  drop_list();
  store.codes(codes_);
  levels_.build(store.keys().data(), codes_, stats_.of(store), levels);
  sink.reserve(codes_.size());
  levels_.pairs(store.keys().data(), Doubt::decide, sink);
}

void NeighbourListFinder::validate(const BoxStore& store) const {
  levels_.validate();
  if (!alive_ || !store.touched().empty()) return;
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  require(fat_.size() == store.slots() && filed_as_.size() == loose_.size(), "neighbour list: a box is lost");
  for (std::size_t i = 0; i < loose_.size(); ++i)
    require(fat_[loose_[i]].lo[3] == static_cast<std::int32_t>(i + 1),
            "neighbour list: a loose box has no index");
  std::vector<std::uint32_t> all(fat_.size()), out;
  for (std::size_t s = 0; s < all.size(); ++s) all[s] = static_cast<std::uint32_t>(s);
  find_escapes(store.keys().data(), fat_.data(), all, out);
  require(out.empty(), "neighbour list: a box is not in its fat box");
  for (std::size_t s = 0, c = 0; s < end_.size(); c = end_[s], ++s)
    for (std::size_t i = c; i < end_[s]; ++i)
      require(second_[i] > (i > c ? second_[i - 1] : s) && second_[i] < fat_.size(),
              "neighbour list: candidates are out of order");
  require(std::is_sorted(loose_candidates_.begin(), loose_candidates_.end(), in_order),
          "neighbour list: loose candidates are out of order");
}

void NeighbourListFinder::drop_list() {
  alive_ = false;
  release(fat_);
  release(second_);
  release(end_);
  release(loose_);
  release(escaped_);
  release(filed_as_);
  release(with_filed_);
  release(loose_candidates_);
}

void NeighbourListFinder::forget() {
  drop_list();
  release(codes_);
  levels_.forget();
  loose_levels_.forget();
}

std::size_t NeighbourListFinder::memory_bytes() const {
  return (fat_.capacity() + filed_as_.capacity()) * sizeof(KeyBox) +
         (end_.capacity() + second_.capacity() + loose_.capacity() + escaped_.capacity() +
          codes_.capacity()) *
             sizeof(std::uint32_t) +
         (with_filed_.capacity() + loose_candidates_.capacity()) * sizeof(SlotPair) + levels_.memory_bytes() +
         loose_levels_.memory_bytes();
}

std::string NeighbourListFinder::explain() const {
  if (!answered_) return levels_.explain() + " (no neighbour list: too many boxes move far or are new)";
  return "neighbour list number " + std::to_string(lists_) + ", " + std::to_string(age_) +
         " queries old: " + std::to_string(candidates_) + " candidates, " + std::to_string(loose_.size()) +
         " loose boxes with " + std::to_string(loose_candidates_.size()) + "; built from " +
         levels_.explain();
}

BroadPhasePtr make_neighbour_list(const Options& options) {
  return std::make_unique<StoredPhase<NeighbourListFinder>>(options);
}

}  // namespace touchstone::broad
