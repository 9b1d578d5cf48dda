// The inner loops of the grid in SIMD, chosen at run time for the processor (Highway): computing cells,
// filing, sweeping, lookup.
#pragma once

#include <cstdint>
#include <vector>

#include "core/broad/pair_kernels.h"

namespace touchstone::broad {

/// A box as filed in a cell. 32 bytes, so that filing takes two stores.
struct alignas(32) GridEntry {
  std::int32_t lo[3] = {no_key, no_key, no_key};
  std::uint32_t code = 0;  // pair_kernels.h, with the owner flags of this column
  std::int32_t hi[3] = {-no_key, -no_key, -no_key};
  std::uint32_t column = 0xffffffff;
};

/// Columns (u, v) on two axes, each cut into cells along the third axis, w. Cell (u, v, w) has place
/// (u·stride_u + v·stride_v + w) & mask in the table, so that the cells of a column are consecutive. Dense:
/// every cell has its own place. Hashed: columns may share places, which only costs comparisons, because each
/// entry stores its column.
struct GridShape {
  int axis_w = 0, axis_u = 1, axis_v = 2;
  // By world axis; the fourth lane is padding. The cell of a coordinate x is (x − origin)·scale, clamped to
  // [0, last]. This is monotone (difference and product with a positive number round monotonically, clamping
  // and truncation are monotone), so overlapping boxes share a cell wherever they are, even far away or
  // infinite.
  alignas(16) float origin[4] = {0, 0, 0, 0}, scale[4] = {1, 1, 1, 1}, last[4] = {0, 0, 0, 0};
  std::uint32_t stride_u = 0, stride_v = 0, mask = 0xffffffff;
  std::uint32_t max_cells = 0;  // maximum that a filed box may span along w
  std::uint32_t place(std::uint32_t u, std::uint32_t v, std::uint32_t w) const {
    return (u * stride_u + v * stride_v + w) & mask;
  }
};

inline constexpr unsigned column_bits = 15;  // of each of u and v
inline std::uint32_t column_name(std::uint32_t u, std::uint32_t v) { return u << column_bits | v; }

/// The lowest cell of a box, and whether the box meets the next column on u (bit 30) and on v (bit 31).
struct Filed {
  std::uint32_t place, column, code;
};

struct CellRange {
  std::uint32_t lo[3], hi[3];  // u, v, w
};
CellRange cell_range(const GridShape& shape, const KeyBox& box);

/// Computes the cells of the boxes of `codes` (indices with moving_flag). Appends boxes that span at most 2 ×
/// 2 columns and max_cells to `filed`, the others to `too_large`, and counts the entries of each place c in
/// count[c].
void file_boxes(const GridShape& shape, const KeyBox* boxes, const std::vector<std::uint32_t>& codes,
                std::vector<Filed>& filed, std::vector<std::uint32_t>& too_large, std::uint32_t* count);

/// Writes the entries. next[c] is the index for the next entry of place c; `nowhere` is the index of an entry
/// that may be overwritten.
void write_entries(const GridShape& shape, const KeyBox* boxes, const std::vector<Filed>& filed,
                   std::uint32_t* next, GridEntry* entries, std::size_t nowhere);

/// How to treat boxes that overlap only by their keys (float_key.h).
enum class Doubt { decide, report };

/// Pairs of each entry of [first, last) with the later entries in its cells. Entry i is in place c when
/// begin[c] <= i < begin[c + 1]; `entries` must be readable for 64 entries beyond the end. With
/// Doubt::report, all pairs of overlapping key boxes are reported.
void sweep_entries(const GridShape& shape, const GridEntry* entries, const std::uint32_t* begin,
                   std::size_t first, std::size_t last, Doubt doubt, PairSink& sink);

/// Pairs of a box with the entries of [first, last) that are in its column or, for any_column, that own both
/// axes.
inline constexpr std::uint32_t any_column = 0xffffffff;
void scan_entries(const KeyBox& box, std::uint32_t code, std::uint32_t column, const GridEntry* entries,
                  std::size_t first, std::size_t last, Doubt doubt, PairSink& sink);

}  // namespace touchstone::broad
