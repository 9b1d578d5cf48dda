// The two inner loops shared by all algorithms, in SIMD, chosen at run time for the processor (Highway).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/broad/broad_phase.h"
#include "core/broad/float_key.h"
#include "core/broad/pair_sink.h"

namespace touchstone::broad {

/// A code is a slot with three flags above it. A pair counts when each flag is set in at least one of the two
/// codes: `moving` excludes fixed–fixed pairs; the two `owner` flags let a grid report a pair in only one of
/// its cells.
inline constexpr std::uint32_t slot_mask = 0x1fffffff, moving_flag = 0x20000000, owner_flags = 0xc0000000;

/// Key boxes in columns, so that one load reads many boxes. The owner chooses the order of the axes. Readable
/// for `padding` entries beyond the end.
struct BoxColumns {
  static constexpr std::size_t padding = 64;
  std::vector<std::int32_t> lo[3], hi[3];
  std::vector<std::uint32_t> code;
  std::size_t size = 0;

  void resize(std::size_t n);
  /// Axis k of the columns is axis (first_axis + k) % 3 of the box.
  void put(std::size_t at, const KeyBox& b, std::uint32_t with_code, int first_axis) {
    for (int k = 0; k < 3; ++k) {
      const int axis = first_axis + k < 3 ? first_axis + k : first_axis + k - 3;
      lo[k][at] = b.lo[axis];
      hi[k][at] = b.hi[axis];
    }
    code[at] = with_code;
  }
  /// Fills in the boxes from the slots in their codes.
  void gather(const BoxStore& store, int first_axis);
  std::size_t memory_bytes() const { return lo[0].capacity() * 7 * sizeof(std::int32_t); }
};

/// Code of a slot outside a grid: both owner flags set.
inline std::uint32_t plain_code(const BoxStore& store, BoxStore::Slot s) {
  return s | owner_flags | (store.is_fixed(s) ? 0 : moving_flag);
}

/// Pairs of each box of [begin, end) with the boxes after it; lo[0] must ascend.
void sweep_range(const BoxColumns& boxes, std::size_t begin, std::size_t end, PairSink& sink);

/// All pairs, in parallel according to the sink's options; lo[0] must ascend.
void sweep_all(const BoxColumns& boxes, PairSink& sink);

/// Pairs of entry `i` of `from` with the entries [begin, end) of `boxes`; both with the same order of axes.
void scan_range(const BoxColumns& from, std::size_t i, const BoxColumns& boxes, std::size_t begin,
                std::size_t end, PairSink& sink);

/// Bit j is set when entry begin + j (j < 16) may overlap entry i of `from`. Compares keys only; codes are
/// ignored.
std::uint32_t overlap_mask_16(const BoxColumns& from, std::size_t i, const BoxColumns& boxes,
                              std::size_t begin);

/// Stores box m of `moves` at index at[m]: the box, its keys, and the largest change of its coordinates
/// (capped at largest_step; the difference of two infinities counts as 0).
void put_boxes(std::span<const BoxUpdate> moves, const std::uint32_t* at, Aabb* boxes, KeyBox* keys,
               float* steps);

}  // namespace touchstone::broad
