// One level of a grid: columns of cells along two axes, unbounded in the third, along which each column is
// swept.
//
// A box is entered in each column that it meets. Two boxes that overlap share the column of the larger of
// their lower cells on both axes; there, and only there, each owner flag is set in one of the two, so each
// pair is reported once. The cell of a coordinate is clamped to the grid, whose border columns thus extend to
// infinity: a monotone map, so that boxes that overlap share a cell wherever they are (negative, far away,
// infinite).
#pragma once

#include "core/broad/key_sort.h"
#include "core/broad/pair_kernels.h"
#include "core/broad/scene_stats.h"

namespace touchstone::broad {

class LevelGrid {
 public:
  /// Enters those of `sorted` (ascending in the key of lo along `axis`) that are small for the cells; the
  /// others are left in `too_large`, in order.
  void build(const BoxStore& store, const std::vector<KeyedSlot>& sorted, int axis, const SceneStats& stats,
             std::vector<KeyedSlot>& too_large);
  /// Pairs among the boxes entered.
  void self_pairs(PairSink& sink) const;
  /// Pairs of the box in slot `s`, which is not entered here, with the boxes entered.
  void query(const BoxStore& store, BoxStore::Slot s, PairSink& sink);

  std::size_t entered() const { return entered_; }
  std::size_t entries() const { return columns_.size; }
  std::size_t cells() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  double cell_size(int k) const { return 1 / static_cast<double>(scale_[k]); }
  void validate() const;
  std::size_t memory_bytes() const;

 private:
  struct Span {
    std::uint32_t from[2], to[2];
    std::size_t size() const { return static_cast<std::size_t>(to[0] - from[0] + 1) * (to[1] - from[1] + 1); }
  };
  void choose_cells(const SceneStats& stats, std::size_t n);
  std::uint32_t cell(std::int32_t key, int k) const;
  Span span_of(const KeyBox& b) const;
  std::size_t count_entries(const BoxStore& store, const std::vector<KeyedSlot>& sorted,
                            std::vector<KeyedSlot>& too_large);
  template <class Visit>
  void each_cell(const Span& s, std::uint32_t code, Visit visit) const;
  template <class Visit>
  void each_of_four(const Span& s, std::uint32_t code, Visit visit) const;
  template <class Visit>
  void visit_cells(const Span& s, std::uint32_t code, Visit visit) const;

  int axis_ = 0;
  float origin_[2] = {}, scale_[2] = {1, 1};
  std::uint32_t count_[2] = {1, 1};
  float longest_ = 0;  // along axis_, of the boxes that may be entered
  std::size_t entered_ = 0;
  std::vector<std::uint32_t> begin_;          // of each column; one more than columns
  std::vector<Span> spans_;                   // of the boxes entered, in order along the axis
  std::vector<std::uint32_t> entered_slots_;  // with moving_flag
  BoxColumns columns_, probe_;
};

}  // namespace touchstone::broad
