// The two inner loops that all algorithms share, in SIMD, chosen at run time for the processor (Highway).
#pragma once

#include <cstdint>
#include <vector>

#include "core/broad/pair_sink.h"

namespace touchstone::broad {

/// A code is a slot with three flags above it. A pair counts when each flag is set in one of the two:
/// `moving` keeps fixed–fixed pairs out; the two `owner` flags let a grid report a pair in one of its cells
/// only.
inline constexpr std::uint32_t slot_mask = 0x1fffffff, moving_flag = 0x20000000, owner_flags = 0xc0000000;

/// Key boxes in columns, axes in an order of the owner's choice, so that one load gives many boxes. Readable
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
      lo[k][at] = b.lo[axis], hi[k][at] = b.hi[axis];
    }
    code[at] = with_code;
  }
  /// Fills the boxes in by the slots in their codes.
  void gather(const BoxStore& store, int first_axis);
  std::size_t memory_bytes() const { return lo[0].capacity() * 7 * sizeof(std::int32_t); }
};

/// Code of a slot without owner: both owner flags set.
inline std::uint32_t plain_code(const BoxStore& store, BoxStore::Slot s) {
  return s | owner_flags | (store.is_fixed(s) ? 0 : moving_flag);
}

/// Pairs of each of [begin, end) with those after it; lo[0] must ascend.
void sweep_range(const BoxColumns& boxes, std::size_t begin, std::size_t end, PairSink& sink);

/// All pairs, in parallel as the sink's options say; lo[0] must ascend.
void sweep_all(const BoxColumns& boxes, PairSink& sink);

/// Pairs of entry `i` of `from` with the entries [begin, end) of `boxes`; both in the same order of axes.
void scan_range(const BoxColumns& from, std::size_t i, const BoxColumns& boxes, std::size_t begin,
                std::size_t end, PairSink& sink);

/// Bit j set: entry begin + j (j < 16) may overlap entry i of `from` (by keys alone; codes are not looked
/// at).
std::uint32_t overlap_mask_16(const BoxColumns& from, std::size_t i, const BoxColumns& boxes,
                              std::size_t begin);

}  // namespace touchstone::broad
