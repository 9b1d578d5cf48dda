#include "core/broad/pair_sink.h"

#include <algorithm>
#include <utility>

namespace touchstone::broad {
namespace {

// Buckets of one first slot hold as many pairs as the box has later partners: a handful in most scenes.
constexpr std::ptrdiff_t insertion_sort_up_to = 24;

void sort_bucket(IdPair* begin, IdPair* end) {
  const auto less = [](const IdPair& a, const IdPair& b) { return a.second < b.second; };
  if (end - begin > insertion_sort_up_to) {
    std::sort(begin, end, less);
    return;
  }
  for (IdPair* i = begin + 1; i < end; ++i) {
    const IdPair p = *i;
    IdPair* j = i;
    for (; j > begin && p.second < j[-1].second; --j) *j = j[-1];
    *j = p;
  }
}

}  // namespace

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

// Counting sort by the first of the pair, then each bucket by the second: O(pairs + slots) and a sort of each
// bucket, all but linear when no box has very many partners.
void PairSink::finish(const BoxStore& store, std::vector<IdPair>& out) {
  decide_doubtful(store);
  const bool ranked = !store.slots_ascend();
  if (ranked) rename_by_rank(store);
  count_.assign(store.slots() + 1, 0);
  for (std::size_t i = 0; i < n; ++i) ++count_[first[i]];
  std::uint32_t sum = 0;
  for (std::uint32_t& c : count_) sum += std::exchange(c, sum);
  out.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    out[count_[first[i]]++] = {static_cast<int>(first[i]), static_cast<int>(second[i])};
  std::uint32_t begin = 0;
  for (std::size_t s = 0; s < store.slots(); begin = count_[s], ++s)
    if (count_[s] - begin > 1) sort_bucket(out.data() + begin, out.data() + count_[s]);
  if (store.ids_are_slots()) return;
  for (IdPair& p : out) {
    const auto a = static_cast<std::uint32_t>(p.first), b = static_cast<std::uint32_t>(p.second);
    p = ranked ? IdPair{by_rank_[a], by_rank_[b]} : IdPair{store.id(a), store.id(b)};
  }
}

}  // namespace touchstone::broad
