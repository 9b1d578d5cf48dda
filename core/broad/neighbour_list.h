// Neighbour list (Verlet 1967, with the skin of molecular dynamics): boxes that move little keep their
// neighbours.
//
// Each box gets a fat box, wider by a few of its last steps. The pairs of overlapping fat boxes are kept as
// sorted candidates until they no longer suffice. A query streams through the candidates and reports those
// whose boxes overlap: no search, and no sort, because the candidates are in order. A box that has left its
// fat box (a "loose" box) gets a new one and is searched for candidates on its own, in the grid from which
// the list was built. When too many boxes are loose, the list is rebuilt. A scene in which most boxes move
// far in a step, or many are inserted and removed, gets no list and uses the grid (grid.h).
//
// Guarantee: at each query every present box is inside its fat box, and every pair of overlapping fat boxes
// is a candidate, in the list or among the loose boxes; so no pair is lost. The boxes themselves decide each
// candidate, so there are no false positives.
#pragma once

#include "core/broad/grid.h"

namespace touchstone::broad {

class NeighbourListFinder {
 public:
  /// Either fills `out` with pairs of slots in order and returns true, or fills `sink` and returns false.
  bool find_sorted(const BoxStore& store, PairSink& sink, std::vector<IdPair>& out) {
    if (keep_up(store, sink, out)) return true;
    search(store, sink);
    return false;
  }
  /// The list's part of find_sorted(). Returns false without a result when the scene gets no list.
  bool keep_up(const BoxStore& store, PairSink& sink, std::vector<IdPair>& out);
  /// The grid's part of find_sorted(), without a list.
  void search(const BoxStore& store, PairSink& sink);
  /// Makes the next query start from scratch. Call when a query was answered elsewhere.
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
  // In queries: age of the list; how long to go without one; the last such wait.
  int age_ = 0, wait_ = 0, patience_ = 0;
  long lists_ = 0;
  std::size_t work_ = 0;  // spent on loose boxes since the list was built
  std::uint64_t membership_ = 0;
  // By slot. Fourth lanes: lo holds 1 + the index among the loose boxes, or 0; hi holds whether the box was
  // fixed when filed.
  std::vector<KeyBox> fat_;
  std::vector<std::uint32_t> end_, second_;  // candidates, grouped by first slot
  std::size_t candidates_ = 0;
  GridLevels levels_;  // over the fat boxes as they were when the list was built, or over the boxes
  // The loose boxes: their slots, the boxes that they are filed under, and the candidates with a loose box.
  std::vector<std::uint32_t> loose_, escaped_;
  std::vector<KeyBox> filed_as_;
  std::vector<SlotPair> with_filed_, loose_candidates_;
  GridLevels loose_levels_;
  std::vector<std::uint32_t> codes_;
};

BroadPhasePtr make_neighbour_list(const Options& options = {});

}  // namespace touchstone::broad
