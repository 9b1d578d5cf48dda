#include "core/broad/pair_sink.h"

#include <algorithm>
#include <utility>

#include "core/broad/list_kernels.h"

namespace touchstone::broad {
void PairSink::grow(std::size_t more) {
  const std::size_t size = std::max(n + more, first.size() + first.size() / 2) + 64;
  first.resize(size), second.resize(size);
}

void PairSink::decide_doubtful(const BoxStore& store) {
  for (const SlotPair& p : doubtful)
    if (overlaps(store.boxes()[p.first], store.boxes()[p.second])) add(p.first, p.second);
  doubtful.clear();
}

void PairSink::accept_doubtful() {
  for (const SlotPair& p : doubtful) add(p.first, p.second);
  doubtful.clear();
}

// Slots were reused or filled out of order: each slot is renamed by the rank of its id.
void PairSink::rename_by_rank(const BoxStore& store) {
  if (ranked_at_ != store.membership()) {
    by_rank_.clear();
    std::vector<std::pair<int, std::uint32_t>> order;
    for (std::uint32_t s = 0; s < store.slots(); ++s)
      if (store.is_present(s)) order.emplace_back(store.id(s), s);
    std::sort(order.begin(), order.end());
    rank_.assign(store.slots(), 0);
    for (const auto& [id, s] : order)
      rank_[s] = static_cast<std::uint32_t>(by_rank_.size()), by_rank_.push_back(id);
    ranked_at_ = store.membership();
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t a = rank_[first[i]], b = rank_[second[i]];
    first[i] = std::min(a, b), second[i] = std::max(a, b);
  }
}

// Counting sort.
void PairSink::group(std::size_t slots, std::vector<std::uint32_t>& end,
                     std::vector<std::uint32_t>& second_by_first) const {
  end.assign(slots, 0);
  for (std::size_t i = 0; i < n; ++i) ++end[first[i]];
  std::uint32_t sum = 0;
  for (std::uint32_t& c : end) sum += std::exchange(c, sum);
  if (second_by_first.size() < n + list_padding) second_by_first.resize(n + list_padding);
  for (std::size_t i = 0; i < n; ++i) second_by_first[end[first[i]]++] = second[i];
}

// Grouped by the first of the pair, each group sorted by the second: O(pairs + slots) and a sort of each
// group, all but linear when no box has very many partners.
void PairSink::finish(const BoxStore& store, std::vector<IdPair>& out) {
  decide_doubtful(store);
  const bool ranked = !store.slots_ascend();
  if (ranked) rename_by_rank(store);
  group(store.slots(), count_, grouped_);
  out.resize(n);
  write_buckets(count_.data(), count_.size(), grouped_.data(), out.data());
  if (store.ids_are_slots()) return;
  for (IdPair& p : out) {
    const auto a = static_cast<std::uint32_t>(p.first), b = static_cast<std::uint32_t>(p.second);
    p = ranked ? IdPair{by_rank_[a], by_rank_[b]} : IdPair{store.id(a), store.id(b)};
  }
}

void PairSink::name(const BoxStore& store, std::vector<IdPair>& out) {
  if (store.ids_are_slots()) return;
  if (store.slots_ascend()) {
    for (IdPair& p : out)
      p = {store.id(static_cast<std::uint32_t>(p.first)), store.id(static_cast<std::uint32_t>(p.second))};
    return;
  }
  clear();
  reserve(out.size());
  for (const IdPair& p : out)
    first[n] = static_cast<std::uint32_t>(p.first), second[n++] = static_cast<std::uint32_t>(p.second);
  finish(store, out);
}

}  // namespace touchstone::broad
