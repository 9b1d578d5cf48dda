// The method is chosen from the scene, anew at each query:
//   few boxes                               brute force: nothing to build
//   most boxes stay near where they were    neighbour list: nothing to search or sort
//   few boxes in the reach of a sweep       sort and sweep: cheapest to build
//   otherwise                               hierarchical grid (with one level when sizes are even)
// Against the best fixed method, measured in one run (bench_broad, 2026-11-22, Zen 3, a busy machine): 0.80
// to 1.07 of its time in the 15 cells of 1e3 to 1e5 boxes. Against a plain sweep or grid that sorts no pairs
// and checks no box: 0.8 to 2.5 times as fast where all boxes move, 3 to 9 times where one in 20 does. Where
// nothing can be kept (teleport) the search is the same counting sort as theirs; of 1000 boxes' query a fifth
// is the taking in of the boxes, a fifth the sorting of the pairs. explain() says which, and the figures that
// decided. The pairs are the same whatever is chosen.
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
