// The method is chosen from the scene, anew at each query:
//   few boxes                                   brute force: nothing to build
//   few have changed for some queries in a row  bounding-volume hierarchy: only the changed boxes look for
//   partners most boxes are fixed                        the same: fixed boxes are never compared few boxes
//   in the reach of a sweep           sort and sweep: cheapest to build otherwise hierarchical grid (with one
//   level when sizes are even)
// explain() says which, and the figures that decided. The pairs are the same whatever is chosen.
#pragma once

#include "core/broad/bounding_volume_hierarchy.h"
#include "core/broad/brute_force.h"
#include "core/broad/grid.h"
#include "core/broad/sort_and_sweep.h"

namespace touchstone::broad {

class AutomaticFinder {
 public:
  void find(const BoxStore& store, PairSink& sink);
  void validate(const BoxStore& store) const;
  std::size_t memory_bytes() const;
  std::string explain() const;

 private:
  enum class Method { brute_force, hierarchy, sweep, grid };
  Method choose(const BoxStore& store);
  Method method_ = Method::brute_force;
  std::string why_;
  RememberedStats stats_;
  std::uint64_t membership_ = ~std::uint64_t{0};
  unsigned quiet_queries_ = 0;
  BruteForceFinder brute_force_;
  HierarchyFinder hierarchy_;
  SortAndSweepFinder sweep_;
  HierarchicalGridFinder grid_;
};

BroadPhasePtr make_automatic();

}  // namespace touchstone::broad
