// Chooses a method from the scene, again at each query:
//   few boxes                               brute force: nothing to build
//   most boxes stay near where they were    neighbour list: nothing to search or sort
//   few boxes in the reach of a sweep       sort and sweep: cheapest to build
//   otherwise                               hierarchical grid (with one level when sizes are similar)
// Compared with the best fixed method in one run (bench_broad, 2026-11-22, Zen 3, a busy machine), it takes
// 0.80 to 1.07 of the time in the 15 cells of 1e3 to 1e5 boxes. Compared with a plain sweep or grid that
// neither sorts pairs nor validates boxes, it is 0.8 to 2.5 times as fast when all boxes move and 3 to 9
// times when one in 20 does. When nothing can be kept (teleport) the search is the same counting sort as
// theirs; in a query of 1000 boxes a fifth of the time goes to storing the boxes and a fifth to sorting the
// pairs. explain() reports the choice and the figures behind it. The pairs are the same whatever is chosen.
#pragma once

#include "core/broad/brute_force.h"
#include "core/broad/neighbour_list.h"
#include "core/broad/sort_and_sweep.h"

namespace touchstone::broad {

class AutomaticFinder {
 public:
  /// See NeighbourListFinder::find_sorted.
  bool find_sorted(const BoxStore& store, PairSink& sink, std::vector<IdPair>& out);
  void validate(const BoxStore& store) const;
  std::size_t memory_bytes() const;
  std::string explain() const;
  Structure structure() const;

 private:
  enum class Method { brute_force, neighbour_list, sweep, grid };
  Method method_ = Method::brute_force;
  // The figures behind the choice; −1: not computed.
  std::size_t boxes_ = 0, changed_ = 0;
  double reach_ = -1;
  RememberedStats stats_;
  BruteForceFinder brute_force_;
  NeighbourListFinder list_;
  SortAndSweepFinder sweep_;
};

BroadPhasePtr make_automatic(const Options& options = {});

}  // namespace touchstone::broad
