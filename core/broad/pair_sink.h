// Where the kernels put what they find: pairs that are certain, and pairs for which the doubles must decide.
#pragma once

#include <cstdint>
#include <vector>

#include "core/broad/box_store.h"

namespace touchstone::broad {

struct SlotPair {
  std::uint32_t first = 0, second = 0;  // first < second
};

class PairSink {
 public:
  void clear() { n = 0, doubtful.clear(); }
  /// Room for `more` entries beyond n in both columns.
  void reserve(std::size_t more) {
    if (n + more > first.size()) grow(more);
  }
  void add(std::uint32_t a, std::uint32_t b) {
    reserve(1);
    first[n] = a < b ? a : b, second[n] = a < b ? b : a, ++n;
  }
  std::size_t memory_bytes() const {
    return (first.capacity() + second.capacity() + grouped_.capacity() + count_.capacity() +
            rank_.capacity()) *
               4 +
           doubtful.capacity() * sizeof(SlotPair) + by_rank_.capacity() * 4;
  }
  /// Groups the second slots by the first: bucket s ends at end[s]; the bucket before it ends where it
  /// begins.
  void group(std::size_t slots, std::vector<std::uint32_t>& end,
             std::vector<std::uint32_t>& second_by_first) const;
  /// Adds those doubtful pairs whose double boxes overlap.
  void decide_doubtful(const BoxStore& store);
  /// Adds all doubtful pairs.
  void accept_doubtful();
  /// Decides the doubtful pairs by their double boxes and writes all pairs by id, sorted. Each pair must have
  /// been put in once.
  void finish(const BoxStore& store, std::vector<IdPair>& out);

  /// Pairs of slots, in order, become pairs of ids, in order.
  void name(const BoxStore& store, std::vector<IdPair>& out);

  std::vector<std::uint32_t> first, second;  // the first n entries count
  std::size_t n = 0;
  std::vector<SlotPair> doubtful;

 private:
  void grow(std::size_t more);
  void rename_by_rank(const BoxStore& store);
  std::vector<std::uint32_t> count_, rank_, grouped_;
  std::vector<int> by_rank_;
  std::uint64_t ranked_at_ = ~std::uint64_t{0};
};

}  // namespace touchstone::broad
