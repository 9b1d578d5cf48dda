#include "core/broad/level_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "core/broad/release.h"
#include "core/tolerance.h"

namespace touchstone::broad {
namespace {

constexpr std::size_t padding = 64;  // entries that must be readable beyond the end
constexpr std::uint32_t max_cells_per_box = 64;
constexpr double max_columns_per_axis = 1 << column_bits, max_cells_per_axis = 1 << 24;

// Bounds on coordinates and scales in float: differences and products of bounded values are never NaN.
constexpr double bound = 1e30, least_scale = 1e-30;
// Strides of the hash: the powers -1 and -2 of the plastic number; see choose_cells().
constexpr double plastic_1 = 0.7548776662466927, plastic_2 = 0.5698402909980532;
// The length of column in the cells that a box reaches, in units of the typical box.
constexpr double reach_of_box = 1.25;

float bounded(double x) { return static_cast<float>(std::clamp(x, -bound, bound)); }

double positive(double x, double otherwise) { return x > 0 && std::isfinite(x) ? x : otherwise; }

}  // namespace

// Columns are at least grid_cell_factor times as wide as the typical box, so that a box meets few of them,
// and wide enough for a box to meet about grid_window others in the cells that it reaches, as many as one
// wide comparison takes. Cells along w are a fraction of the typical box, so that few comparisons are wasted.
void LevelGrid::choose_cells(const SceneStats& stats, std::size_t n) {
  const int w = best_axis(stats), u = (w + 1) % 3, v = (w + 2) % 3;
  shape_ = {};
  shape_.axis_w = w;
  shape_.axis_u = u;
  shape_.axis_v = v;
  shape_.max_cells = max_cells_per_box;
  const double along = positive(stats.median_size[w], 0);
  const double area =
      tolerance::grid_window / (stats.density * static_cast<double>(n) * along * reach_of_box);
  const double side = std::isfinite(area) && area > 0 ? std::sqrt(area) : 0;
  double count[3] = {1, 1, 1};
  for (const int k : {w, u, v}) {
    const double extent = std::max(0.0, stats.high[k] - stats.low[k]);
    const double cell = k == w ? along * tolerance::grid_cut
                               : std::max(tolerance::grid_cell_factor * stats.median_size[k], side);
    const double most = k == w ? max_cells_per_axis : max_columns_per_axis;
    const double ratio = cell > 0 ? std::ceil(extent / cell) : 1;
    count[k] = ratio > 1 ? std::min(ratio, most) : 1;  // 1 when the ratio is NaN (infinity over infinity)
    // A world without extent has a single cell of any width.
    const double width = extent > 0 ? extent / count[k] : positive(cell, 1);
    shape_.origin[k] = bounded(stats.low[k]);
    shape_.scale[k] = static_cast<float>(std::clamp(1 / width, least_scale, bound));
    shape_.last[k] = static_cast<float>(count[k] - 1);
  }
  const double all = count[0] * count[1] * count[2], table = static_cast<double>(2 * n + 512);
  if (all <= 2 * table) {
    shape_.stride_v = static_cast<std::uint32_t>(count[w]);
    shape_.stride_u = static_cast<std::uint32_t>(count[w] * count[v]);
    places_ = static_cast<std::size_t>(all);
    ghosts_ = 0;
    return;
  }
  // Extra columns cost nothing here: add as many again on either side of the sample, which may not include
  // the outermost boxes.
  for (int k = 0; k < 3; ++k) {
    const double most = k == w ? max_cells_per_axis : max_columns_per_axis;
    if (3 * count[k] > most) continue;
    shape_.origin[k] = bounded(stats.low[k] - std::max(0.0, stats.high[k] - stats.low[k]));
    shape_.last[k] = static_cast<float>(3 * count[k] - 1);
  }
  // Strides from the plastic number (the two-dimensional analogue of the golden ratio): neighbouring columns
  // start far from each other, and starts fill the table evenly. Odd strides visit the whole table.
  places_ = std::bit_ceil(n + 512);
  ghosts_ = max_cells_per_box + 1;
  shape_.mask = static_cast<std::uint32_t>(places_ - 1);
  shape_.stride_u = static_cast<std::uint32_t>(plastic_1 * static_cast<double>(places_)) | 1;
  shape_.stride_v = static_cast<std::uint32_t>(plastic_2 * static_cast<double>(places_)) | 1;
}

void LevelGrid::build(const KeyBox* boxes, const std::vector<std::uint32_t>& codes, const SceneStats& stats,
                      std::vector<std::uint32_t>& too_large) {
  choose_cells(stats, codes.size());
  thin_ = false;
  too_large.clear();
  // Counts are stored two places ahead. After the prefix sums, next[c] = begin[c + 1] is where place c
  // begins; after all entries have been written it is where place c ends, and begin[c] is where it begins.
  begin_.assign(places_ + ghosts_ + 2, 0);
  file_boxes(shape_, boxes, codes, filed_, too_large, begin_.data() + 2);
  boxes_ = filed_.size();
  std::uint32_t sum = 0;
  for (std::size_t c = 2; c < places_ + 2; ++c) {
    sum += begin_[c];
    begin_[c] = sum;
  }
  count_ = sum;
  // There are at most as many copies as entries.
  if (entries_.size() < count_ + padding) resize_exactly(entries_, count_ + count_ / 32 + padding);
  write_entries(shape_, boxes, filed_, begin_.data() + 1, entries_.data(), count_);
  if (ghosts_ == 0) return;
  const std::size_t copies = begin_[ghosts_];
  if (entries_.size() < count_ + copies + padding) resize_exactly(entries_, count_ + copies + padding);
  std::copy_n(entries_.begin(), copies, entries_.begin() + static_cast<std::ptrdiff_t>(count_));
  for (std::size_t c = 0; c <= ghosts_; ++c) begin_[places_ + c] = sum + begin_[c];
}

void LevelGrid::self_pairs(Doubt doubt, std::size_t parts, std::size_t part, PairSink& sink) const {
  deal_chunks(count_, 2048, parts, part, [&](std::size_t begin, std::size_t end) {
    sweep_entries(shape_, entries_.data(), begin_.data(), begin, end, doubt, sink);
  });
}

// Keeps the entries that own both axes: one per box. Their order is preserved, so that each place keeps its
// entries; the copies beyond the end of the table are rebuilt.
void LevelGrid::thin_out() {
  std::size_t kept = 0;
  for (std::size_t c = 0, i = 0; c < places_; ++c) {
    const std::size_t end = begin_[c + 1];
    begin_[c] = static_cast<std::uint32_t>(kept);
    for (; i < end; ++i)
      if ((entries_[i].code & owner_flags) == owner_flags) entries_[kept++] = entries_[i];
  }
  begin_[places_] = static_cast<std::uint32_t>(kept);
  count_ = kept;
  thin_ = true;
  const std::size_t copies = ghosts_ > 0 ? begin_[ghosts_] : 0;
  for (std::size_t c = 0; c <= ghosts_; ++c)
    begin_[places_ + c] = static_cast<std::uint32_t>(kept) + begin_[c];
  entries_.resize(kept + copies + padding);
  std::copy_n(entries_.begin(), copies, entries_.begin() + static_cast<std::ptrdiff_t>(kept));
  entries_.shrink_to_fit();
  release(filed_);
}

// Scans `cells` places from `from` on, wrapping around at the end of the table.
void LevelGrid::scan_places(const KeyBox& box, std::uint32_t code, std::uint32_t column, std::uint32_t from,
                            std::uint32_t cells, Doubt doubt, PairSink& sink) const {
  const std::size_t end = std::min<std::size_t>(std::size_t{from} + cells, places_);
  if (begin_[from] < begin_[end])
    scan_entries(box, code, column, entries_.data(), begin_[from], begin_[end], doubt, sink);
  const std::size_t around = std::min<std::size_t>(std::size_t{from} + cells - end, from);
  if (around > 0 && begin_[around] > 0)
    scan_entries(box, code, column, entries_.data(), 0, begin_[around], doubt, sink);
}

void LevelGrid::query(const KeyBox& box, std::uint32_t code, Doubt doubt, PairSink& sink) const {
  CellRange r = cell_range(shape_, box);
  if (thin_)
    for (int k = 0; k < 2; ++k) r.lo[k] -= std::min(r.lo[k], 1U);
  const std::uint32_t from_w = r.lo[2] - std::min(r.lo[2], shape_.max_cells);
  const std::uint32_t cells =
      static_cast<std::uint32_t>(std::min<std::size_t>(r.hi[2] - from_w + 1, places_));
  const double columns = (r.hi[0] - r.lo[0] + 1.0) * (r.hi[1] - r.lo[1] + 1.0);
  // Visiting a column costs about as much as 16 entries.
  if (columns * 16 > static_cast<double>(count_)) {
    scan_entries(box, code | owner_flags, any_column, entries_.data(), 0, count_, doubt, sink);
    return;
  }
  for (std::uint32_t u = r.lo[0]; u <= r.hi[0]; ++u)
    for (std::uint32_t v = r.lo[1]; v <= r.hi[1]; ++v) {
      const std::uint32_t owner =
          (thin_ || u == r.lo[0] ? 0x80000000U : 0) | (thin_ || v == r.lo[1] ? 0x40000000U : 0);
      scan_places(box, code | owner, column_name(u, v), shape_.place(u, v, from_w), cells, doubt, sink);
    }
}

Structure::Grid LevelGrid::picture() const {
  Structure::Grid g;
  g.along = shape_.axis_w;
  for (int k = 0; k < 3; ++k) {
    g.origin[k] = static_cast<double>(shape_.origin[k]);
    g.cell[k] = cell_size(k);
    g.count[k] = static_cast<long>(shape_.last[k]) + 1;
  }
  return g;
}

void LevelGrid::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  if (begin_.empty()) return;
  require(begin_.front() == 0 && begin_[places_] == count_, "grid: places do not cover the entries");
  std::size_t owners = 0;
  for (std::size_t c = 0; c < places_; ++c) {
    require(begin_[c] <= begin_[c + 1], "grid: places overlap");
    for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i) {
      const GridEntry& e = entries_[i];
      const CellRange r =
          cell_range(shape_, {{e.lo[0], e.lo[1], e.lo[2], 0}, {e.hi[0], e.hi[1], e.hi[2], 0}});
      const std::uint32_t u = e.column >> column_bits, v = e.column & ((1U << column_bits) - 1);
      require(u >= r.lo[0] && u <= r.hi[0] && v >= r.lo[1] && v <= r.hi[1],
              "grid: a box is in a wrong column");
      require(shape_.place(u, v, r.lo[2]) == c, "grid: a box is in a wrong place");
      require(((e.code >> 31) != 0) == (u == r.lo[0]) && ((e.code >> 30 & 1) != 0) == (v == r.lo[1]),
              "grid: an owner flag is wrong");
      owners += (e.code & owner_flags) == owner_flags ? 1 : 0;
    }
  }
  require(owners == boxes_, "grid: a box has no entry that owns both axes");
}

std::size_t LevelGrid::memory_bytes() const {
  return entries_.capacity() * sizeof(GridEntry) + filed_.capacity() * sizeof(Filed) +
         begin_.capacity() * sizeof(std::uint32_t);
}

}  // namespace touchstone::broad
