// The inner loops of the grid in SIMD, chosen at run time for the processor (Highway): cells of boxes,
// filing, sweeping, looking up.
#pragma once

#include <cstdint>
#include <vector>

#include "core/broad/pair_kernels.h"

namespace touchstone::broad {

/// A box as it is filed in a cell. 32 bytes, so that filing is two stores.
struct alignas(32) GridEntry {
  std::int32_t lo[3] = {no_key, no_key, no_key};
  std::uint32_t code = 0;  // pair_kernels.h, with the owner flags of this column
  std::int32_t hi[3] = {-no_key, -no_key, -no_key};
  std::uint32_t column = 0xffffffff;
};

/// Cells: columns (u, v) on two axes, each cut along the third axis, w. Cell (u, v, w) has place
/// (u·stride_u + v·stride_v + w) & mask in the table, so that a column's cells follow each other there.
/// Dense: every cell has a place of its own. Hashed: columns lie over each other, which costs comparisons
/// alone, for each entry names its column.
struct GridShape {
  int axis_w = 0, axis_u = 1, axis_v = 2;
  // By world axis; the fourth lane is filling. The cell of a coordinate x is (x − origin)·scale, clamped to
  // [0, last]: monotone (difference and product with a positive number round monotonically, clamps and
  // truncation are monotone), so that boxes that overlap share a cell wherever they are: far away, infinite.
  alignas(16) float origin[4] = {0, 0, 0, 0}, scale[4] = {1, 1, 1, 1}, last[4] = {0, 0, 0, 0};
  std::uint32_t stride_u = 0, stride_v = 0, mask = 0xffffffff;
  std::uint32_t most_cells = 0;  // that an entered box may span along w
  std::uint32_t place(std::uint32_t u, std::uint32_t v, std::uint32_t w) const {
    return (u * stride_u + v * stride_v + w) & mask;
  }
};

inline constexpr unsigned column_bits = 15;  // of each of u and v
inline std::uint32_t column_name(std::uint32_t u, std::uint32_t v) { return u << column_bits | v; }

/// A box's lowest cell, and whether it meets the next column on u (bit 30), on v (bit 31).
struct Filed {
  std::uint32_t place, column, code;
};

struct CellRange {
  std::uint32_t lo[3], hi[3];  // u, v, w
};
CellRange cell_range(const GridShape& shape, const KeyBox& box);

/// Finds the cells of the boxes of `codes` (indices with moving_flag), appends those that span at most 2 × 2
/// columns and most_cells to `filed` and the others to `too_large`; counts the entries of each place c in
/// count[c].
void file_boxes(const GridShape& shape, const KeyBox* boxes, const std::vector<std::uint32_t>& codes,
                std::vector<Filed>& filed, std::vector<std::uint32_t>& too_large, std::uint32_t* count);

/// Writes the entries; next[c] is where the next entry of place c goes, `nowhere` one that may be
/// overwritten.
void write_entries(const GridShape& shape, const KeyBox* boxes, const std::vector<Filed>& filed,
                   std::uint32_t* next, GridEntry* entries, std::size_t nowhere);

/// What to make of boxes that overlap by their keys alone (float_key.h).
enum class Doubt { decide, report };

/// Pairs of each entry of [first, last) with the later ones in its cells. Entry i is in place c when
/// begin[c] <= i < begin[c + 1]; `entries` is readable for 64 beyond the end. With Doubt::report all pairs of
/// key boxes that overlap are reported.
void sweep_entries(const GridShape& shape, const GridEntry* entries, const std::uint32_t* begin,
                   std::size_t first, std::size_t last, Doubt doubt, PairSink& sink);

/// Pairs of a box with the entries of [first, last) that are in its column, or, for any_column, with those
/// that own both axes.
inline constexpr std::uint32_t any_column = 0xffffffff;
void scan_entries(const KeyBox& box, std::uint32_t code, std::uint32_t column, const GridEntry* entries,
                  std::size_t first, std::size_t last, Doubt doubt, PairSink& sink);

}  // namespace touchstone::broad
