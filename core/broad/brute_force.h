// Tests every pair of boxes, many at a time: n(n−1)/2 tests. The reference for every other algorithm, and the
// fastest one for few boxes.
#pragma once

#include "core/broad/pair_kernels.h"

namespace touchstone::broad {

class BruteForceFinder {
 public:
  void find(const BoxStore& store, PairSink& sink);
  void validate(const BoxStore&) const {}
  std::size_t memory_bytes() const { return columns_.memory_bytes(); }
  std::string explain() const { return "brute force"; }

 private:
  BoxColumns columns_;
};

BroadPhasePtr make_brute_force(const Options& options = {});

}  // namespace touchstone::broad
