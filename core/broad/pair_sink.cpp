#include "core/broad/pair_sink.h"

#include <algorithm>
#include <utility>

#include "core/broad/list_kernels.h"
#include "core/broad/release.h"

namespace touchstone::broad {

PairSink::PairSink(const Options& options) : options_(options) {
  if (options.threads < 1) throw std::invalid_argument("broad phase: threads must be 1 or more");
  threads_ = static_cast<std::size_t>(options.threads);
  options_.min_work_per_part = std::max<std::size_t>(1, options.min_work_per_part);
}

std::size_t PairSink::memory_bytes() const {
  std::size_t sum = (first.capacity() + second.capacity() + grouped_.capacity() + count_.capacity() +
                     rank_.capacity() + by_rank_.capacity()) *
                        sizeof(std::uint32_t) +
                    doubtful.capacity() * sizeof(SlotPair) +
                    (others_.capacity() - others_.size()) * sizeof(PairSink);
  for (const PairSink& other : others_) sum += sizeof other + other.memory_bytes();
  return sum;
}

void PairSink::release_memory() {
  clear();
  release(first);
  release(second);
  release(doubtful);
  release(grouped_);
  release(count_);
  for (PairSink& other : others_) other.release_memory();
}

void PairSink::append(const PairSink& other) {
  reserve(other.n);
  std::copy_n(other.first.begin(), other.n, first.begin() + static_cast<std::ptrdiff_t>(n));
  std::copy_n(other.second.begin(), other.n, second.begin() + static_cast<std::ptrdiff_t>(n));
  n += other.n;
  doubtful.insert(doubtful.end(), other.doubtful.begin(), other.doubtful.end());
}

void PairSink::grow(std::size_t more) {
  const std::size_t size = std::max(n + more, first.size() + first.size() / 8) + 64;
  resize_exactly(first, size);
  resize_exactly(second, size);
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

// Used when slots were reused or filled out of order: replaces each slot by the rank of its id.
void PairSink::rename_by_rank(const BoxStore& store) {
  if (ranked_at_ != store.membership()) {
    by_rank_.clear();
    std::vector<std::pair<int, std::uint32_t>> order;
    for (std::uint32_t s = 0; s < store.slots(); ++s)
      if (store.is_present(s)) order.emplace_back(store.id(s), s);
    std::sort(order.begin(), order.end());
    rank_.assign(store.slots(), 0);
    for (const auto& [id, s] : order) {
      rank_[s] = static_cast<std::uint32_t>(by_rank_.size());
      by_rank_.push_back(id);
    }
    ranked_at_ = store.membership();
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t a = rank_[first[i]], b = rank_[second[i]];
    first[i] = std::min(a, b);
    second[i] = std::max(a, b);
  }
}

// Counting sort. Each part counts its share of the pairs in its own table. The table of the last part comes
// first in `end`, because that part's share of a bucket ends where the bucket ends.
void PairSink::group(std::size_t slots, std::vector<std::uint32_t>& end,
                     std::vector<std::uint32_t>& second_by_first) const {
  if (second_by_first.size() < n + list_padding) resize_exactly(second_by_first, n + n / 32 + list_padding);
  const std::size_t parts = this->parts(n);
  end.assign(slots * parts, 0);
  const auto table = [&](std::size_t p) { return end.data() + (parts - 1 - p) * slots; };
  run_parts(parts, [&](std::size_t p) {
    std::uint32_t* const count = table(p);
    for (std::size_t i = part_begin(n, parts, p); i < part_begin(n, parts, p + 1); ++i) ++count[first[i]];
  });
  std::uint32_t sum = 0;
  for (std::size_t s = 0; s < slots; ++s)
    for (std::size_t p = 0; p < parts; ++p) sum += std::exchange(table(p)[s], sum);
  run_parts(parts, [&](std::size_t p) {
    std::uint32_t* const next = table(p);
    for (std::size_t i = part_begin(n, parts, p); i < part_begin(n, parts, p + 1); ++i)
      second_by_first[next[first[i]]++] = second[i];
  });
  end.resize(slots);
}

// Groups the pairs by their first slot and sorts each group by the second: O(pairs + slots) plus a sort of
// each group, close to linear when no box has very many partners. Grouping and sorting in `out` would save
// four bytes per pair, but the load of each group would then wait for the overlapping store of the group
// before it: 15 % of a query of 1000 boxes (2026-11-21, Zen 3).
void PairSink::finish(const BoxStore& store, std::vector<IdPair>& out) {
  decide_doubtful(store);
  const bool ranked = !store.slots_ascend();
  if (ranked) rename_by_rank(store);
  group(store.slots(), count_, grouped_);
  out.resize(n);
  const std::size_t parts = this->parts(n);
  run_parts(parts, [&](std::size_t p) {
    write_buckets(count_.data(), part_begin(store.slots(), parts, p), part_begin(store.slots(), parts, p + 1),
                  grouped_.data(), out.data());
  });
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
  for (const IdPair& p : out) {
    first[n] = static_cast<std::uint32_t>(p.first);
    second[n++] = static_cast<std::uint32_t>(p.second);
  }
  finish(store, out);
}

}  // namespace touchstone::broad
