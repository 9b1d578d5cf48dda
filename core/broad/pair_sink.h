// Output of the kernels: certain pairs, and doubtful pairs for which the doubles must decide.
#pragma once

#include <cstdint>
#include <vector>

#include "core/broad/box_store.h"
#include "core/broad/parts.h"

namespace touchstone::broad {

struct SlotPair {
  std::uint32_t first = 0, second = 0;  // first < second
};

class PairSink {
 public:
  /// Throws std::invalid_argument when options.threads < 1.
  explicit PairSink(const Options& options = {});
  /// The number of parts in which to do this much work (boxes or pairs).
  std::size_t parts(std::size_t work) const {
    return std::clamp<std::size_t>(work / options_.min_work_per_part, 1, threads_);
  }
  /// Calls find(part, sink) for each part, in parallel, and appends the results.
  template <class Find>
  void in_parts(std::size_t parts, const Find& find) {
    if (parts <= 1) {
      find(std::size_t{0}, *this);
      return;
    }
    if (others_.size() + 1 < parts) others_.resize(parts - 1);
    run_parts(parts, [&](std::size_t p) {
      if (p > 0) others_[p - 1].clear();
      find(p, p > 0 ? others_[p - 1] : *this);
    });
    for (std::size_t p = 1; p < parts; ++p) append(others_[p - 1]);
  }
  void clear() {
    n = 0;
    doubtful.clear();
  }
  /// Ensures room for `more` entries beyond n in both columns.
  void reserve(std::size_t more) {
    if (n + more > first.size()) grow(more);
  }
  void add(std::uint32_t a, std::uint32_t b) {
    reserve(1);
    first[n] = a < b ? a : b;
    second[n] = a < b ? b : a;
    ++n;
  }
  std::size_t memory_bytes() const;
  /// Clears the sink and releases large buffers.
  void release_memory();
  /// Groups the second slots by the first: bucket s ends at end[s] and begins where the bucket before it
  /// ends.
  void group(std::size_t slots, std::vector<std::uint32_t>& end,
             std::vector<std::uint32_t>& second_by_first) const;
  /// Adds the doubtful pairs whose double boxes overlap.
  void decide_doubtful(const BoxStore& store);
  /// Adds all doubtful pairs.
  void accept_doubtful();
  /// Decides the doubtful pairs by their double boxes and writes all pairs by id, sorted. Each pair must have
  /// been added once.
  void finish(const BoxStore& store, std::vector<IdPair>& out);

  /// Converts sorted pairs of slots to sorted pairs of ids.
  void name(const BoxStore& store, std::vector<IdPair>& out);

  std::vector<std::uint32_t> first, second;  // the first n entries count
  std::size_t n = 0;
  std::vector<SlotPair> doubtful;

 private:
  void grow(std::size_t more);
  void append(const PairSink& other);
  Options options_;
  std::size_t threads_ = 1;
  std::vector<PairSink> others_;  // sinks of all parts except the first
  void rename_by_rank(const BoxStore& store);
  std::vector<std::uint32_t> count_, rank_, grouped_;
  std::vector<int> by_rank_;
  std::uint64_t ranked_at_ = ~std::uint64_t{0};
};

}  // namespace touchstone::broad
