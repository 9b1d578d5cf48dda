// The method is chosen from the scene, anew at each query:
//   few boxes                               brute force: nothing to build
//   most boxes stay near where they were    neighbour list: nothing to search or sort
//   few boxes in the reach of a sweep       sort and sweep: cheapest to build
//   otherwise                               hierarchical grid (with one level when sizes are even)
// explain() says which, and the figures that decided. The pairs are the same whatever is chosen.
#pragma once

#include "core/broad/brute_force.h"
#include "core/broad/neighbour_list.h"
#include "core/broad/sort_and_sweep.h"

namespace touchstone::broad {

class AutomaticFinder {
 public:
  /// As NeighbourListFinder's.
  bool find_sorted(const BoxStore& store, PairSink& sink, std::vector<IdPair>& out);
  void validate(const BoxStore& store) const;
  std::size_t memory_bytes() const;
  std::string explain() const;
  Structure structure() const;

 private:
  enum class Method { brute_force, neighbour_list, sweep, grid };
  Method method_ = Method::brute_force;
  // What decided; −1: not looked at.
  std::size_t boxes_ = 0, changed_ = 0;
  double reach_ = -1;
  RememberedStats stats_;
  BruteForceFinder brute_force_;
  NeighbourListFinder list_;
  SortAndSweepFinder sweep_;
};

BroadPhasePtr make_automatic(const Options& options = {});

}  // namespace touchstone::broad
