// Neighbour list (Verlet 1967, with the skin of molecular dynamics): boxes that move little keep their
// neighbours.
//
// Each box gets a fat box around it, wider by some of its own last steps, and the pairs of fat boxes that
// overlap are kept as candidates, sorted, until they no longer suffice. A query then streams through the
// candidates and reports those whose boxes overlap: no search, and no sort, for the candidates are in order.
// A box that has left its fat box
// ("loose") gets a new one and looks for its candidates alone, in the grid that the list was made with; when
// too many are loose, the list is made anew. A scene in which most boxes go far in a step, or change by
// coming and going, gets no list: the grid is asked (grid.h).
//
// Guarantee: at each query every box present is inside its fat box, and every pair of overlapping fat boxes
// is a candidate, in the list or among the loose; so no pair is lost. Candidates are decided by the boxes, so
// none is reported in vain.
#pragma once

#include "core/broad/grid.h"

namespace touchstone::broad {

class NeighbourListFinder {
 public:
  /// Either fills `out` with pairs of slots in order and returns true, or fills `sink` and returns false.
  bool find_sorted(const BoxStore& store, PairSink& sink, std::vector<IdPair>& out) {
    return keep_up(store, sink, out) || (search(store, sink), false);
  }
  /// The list's part of it: false, and nothing done, when the scene gets no list.
  bool keep_up(const BoxStore& store, PairSink& sink, std::vector<IdPair>& out);
  /// The grid's part: no list.
  void search(const BoxStore& store, PairSink& sink);
  /// The next query starts from nothing. To be called when a query was answered elsewhere.
  void forget();
  void validate(const BoxStore& store) const;
  std::size_t memory_bytes() const;
  std::string explain() const;
  Structure structure() const { return levels_.structure(); }

 private:
  bool is_coherent(const BoxStore& store);
  void drop_list();
  bool keep(const BoxStore& store, PairSink& sink);
  void build(const BoxStore& store, PairSink& sink);
  void make_fat(const BoxStore& store, BoxStore::Slot s, KeyBox& fat) const;
  void loosen(const BoxStore& store, PairSink& sink);
  void find_loose_pairs(PairSink& sink);
  bool is_listed(BoxStore::Slot a, BoxStore::Slot b) const;
  const KeyBox& built_box(BoxStore::Slot s) const;
  void report(const BoxStore& store, const PairSink& sink, std::vector<IdPair>& out) const;
  std::size_t report_range(const BoxStore& store, std::size_t from, std::size_t to, IdPair* out) const;
  std::size_t loose_before(std::size_t slot) const;

  RememberedStats stats_;
  bool alive_ = false, answered_ = false;
  int age_ = 0, wait_ = 0, patience_ = 0;  // queries: of the list; to go without one; the last such wait
  long lists_ = 0;
  std::size_t work_ = 0;  // spent on loose boxes since the list was made
  std::uint64_t membership_ = 0;
  // By slot. Fourth lanes: lo, 1 + its number among the loose, or 0; hi, whether the box was fixed when
  // filed.
  std::vector<KeyBox> fat_;
  std::vector<std::uint32_t> end_, second_;  // candidates, grouped by first slot
  std::size_t candidates_ = 0;
  GridLevels levels_;  // over the fat boxes as they were when the list was made, or over the boxes
  // The loose: their slots, the boxes that they are filed under, and candidates that have one.
  std::vector<std::uint32_t> loose_, escaped_;
  std::vector<KeyBox> filed_as_;
  std::vector<SlotPair> with_filed_, loose_candidates_;
  GridLevels loose_levels_;
  std::vector<std::uint32_t> codes_;
};

BroadPhasePtr make_neighbour_list(const Options& options = {});

}  // namespace touchstone::broad
