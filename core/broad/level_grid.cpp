#include "core/broad/level_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/tolerance.h"

namespace touchstone::broad {
namespace {

// Finite, so that no difference of two of them and no product below is a NaN.
float bounded(double x) { return static_cast<float>(std::clamp(x, -1e30, 1e30)); }

}  // namespace

// Cells at least twice the usual box, so that a box meets (1 + 1/2)² columns or fewer on average, and so wide
// that a sweep finds about grid_window boxes to compare with in a column, which is what one wide comparison
// takes.
void LevelGrid::choose_cells(const SceneStats& stats, std::size_t n) {
  const double along = stats.median_size[axis_];
  const double area = tolerance::grid_window / (stats.density * static_cast<double>(n) * along);
  const double window_side = std::isfinite(area) && area > 0 ? std::sqrt(area) : 0;
  double cells[2] = {};
  for (int k = 0; k < 2; ++k) {
    const int a = (axis_ + 1 + k) % 3;
    const double extent = std::max(0.0, stats.high[a] - stats.low[a]);
    const double side = std::max(tolerance::grid_cell_factor * stats.median_size[a], window_side);
    cells[k] = side > 0 ? std::clamp(extent / side, 1.0, static_cast<double>(n + 1)) : 1;
  }
  // No more columns than boxes: an empty column costs as much as an entry.
  const double shrink = std::sqrt(std::max(1.0, cells[0] * cells[1] / static_cast<double>(n + 1)));
  for (int k = 0; k < 2; ++k) {
    const int a = (axis_ + 1 + k) % 3;
    const double whole = std::max(std::floor(cells[k] / shrink), 1.0);
    const double extent = stats.high[a] - stats.low[a];
    origin_[k] = bounded(stats.low[a]);
    scale_[k] = static_cast<float>(std::clamp(extent > 0 ? whole / extent : 1.0, 1e-30, 1e30));
    count_[k] = static_cast<std::uint32_t>(whole);
  }
  longest_ = bounded(std::max(along * tolerance::grid_large_factor, stats.spread[axis_] / 256));
}

// Monotone: difference and product with a positive number round monotonically, and so do the clamps; an
// infinity stays one.
std::uint32_t LevelGrid::cell(std::int32_t key, int k) const {
  const float t = (value_of(key) - origin_[k]) * scale_[k];
  const auto last = static_cast<float>(count_[k] - 1);
  const float in = t > 0 ? (t < last ? t : last) : 0;
  return static_cast<std::uint32_t>(in);
}

LevelGrid::Span LevelGrid::span_of(const KeyBox& b) const {
  const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
  return {{cell(b.lo[u], 0), cell(b.lo[v], 1)}, {cell(b.hi[u], 0), cell(b.hi[v], 1)}};
}

template <class Visit>
void LevelGrid::each_cell(const Span& s, std::uint32_t code, Visit visit) const {
  for (std::uint32_t u = s.from[0]; u <= s.to[0]; ++u)
    for (std::uint32_t v = s.from[1]; v <= s.to[1]; ++v)
      visit(u * count_[1] + v, code | (u == s.from[0] ? 0x80000000U : 0) | (v == s.from[1] ? 0x40000000U : 0),
            1U);
}

// The same for a box that meets at most 2 × 2 columns, without a branch: the visit to a column that is none
// has weight 0. How many columns a box meets cannot be predicted; a wrong guess costs more than the visits.
template <class Visit>
void LevelGrid::each_of_four(const Span& s, std::uint32_t code, Visit visit) const {
  const std::uint32_t more_u = s.to[0] - s.from[0], more_v = s.to[1] - s.from[1];
  const std::uint32_t c = s.from[0] * count_[1] + s.from[1], below = c + more_u * count_[1];
  visit(c, code | 0xc0000000U, 1U);
  visit(c + more_v, code | 0x80000000U, more_v);
  visit(below, code | 0x40000000U, more_u);
  visit(below + more_v, code, more_u & more_v);
}

template <class Visit>
void LevelGrid::visit_cells(const Span& s, std::uint32_t code, Visit visit) const {
  if (((s.to[0] - s.from[0]) | (s.to[1] - s.from[1])) <= 1)
    each_of_four(s, code, visit);
  else
    each_cell(s, code, visit);
}

std::size_t LevelGrid::count_entries(const BoxStore& store, const std::vector<KeyedSlot>& sorted,
                                     std::vector<KeyedSlot>& too_large) {
  begin_.assign(static_cast<std::size_t>(count_[0]) * count_[1] + 1, 0);
  spans_.clear(), entered_slots_.clear(), too_large.clear();
  std::size_t entries = 0;
  for (const KeyedSlot& k : sorted) {
    const KeyBox& b = store.keys()[k.slot];
    const Span s = span_of(b);
    if (s.size() > tolerance::grid_cells_a_box ||
        !(value_of(b.hi[axis_]) - value_of(b.lo[axis_]) <= longest_)) {
      too_large.push_back(k);
      continue;
    }
    visit_cells(s, 0, [&](std::uint32_t c, std::uint32_t, std::uint32_t weight) { begin_[c] += weight; });
    spans_.push_back(s), entered_slots_.push_back(k.slot | (store.is_fixed(k.slot) ? 0 : moving_flag));
    entries += s.size();
  }
  return entries;
}

void LevelGrid::build(const BoxStore& store, const std::vector<KeyedSlot>& sorted, int axis,
                      const SceneStats& stats, std::vector<KeyedSlot>& too_large) {
  axis_ = axis;
  choose_cells(stats, sorted.size());
  const std::size_t entries = count_entries(store, sorted, too_large);
  entered_ = spans_.size();
  std::uint32_t sum = 0;
  for (std::uint32_t& b : begin_) sum += b, b = sum;
  columns_.resize(entries);
  // From the back, so that each column's begin ends where it belongs and the order along the axis is kept.
  // Visits without weight write behind the end.
  const auto nowhere = static_cast<std::uint32_t>(entries);
  std::uint32_t* const code = columns_.code.data();
  std::uint32_t* const begin = begin_.data();
  for (std::size_t i = entered_; i-- > 0;)
    visit_cells(spans_[i], entered_slots_[i], [=](std::uint32_t c, std::uint32_t with, std::uint32_t weight) {
      const std::uint32_t at = begin[c] - weight;
      begin[c] = at;
      code[weight != 0 ? at : nowhere] = with;
    });
  code[nowhere] = 0;
  columns_.gather(store, axis_);
}

void LevelGrid::self_pairs(PairSink& sink) const { sweep_groups(columns_, begin_, sink); }

void LevelGrid::query(const BoxStore& store, BoxStore::Slot slot, PairSink& sink) {
  const KeyBox& b = store.keys()[slot];
  probe_.resize(1);
  probe_.put(0, b, 0, axis_);
  const std::int32_t from = earliest_start(b.lo[axis_], longest_);
  const std::int32_t to = b.hi[axis_];
  const auto& lo = columns_.lo[0];
  const std::uint32_t moving = store.is_fixed(slot) ? 0 : moving_flag;
  each_cell(span_of(b), slot | moving, [&](std::uint32_t c, std::uint32_t with, std::uint32_t) {
    if (begin_[c] == begin_[c + 1]) return;
    const auto first = lo.begin() + begin_[c], last = lo.begin() + begin_[c + 1];
    const auto low = std::lower_bound(first, last, from);
    const auto high = std::upper_bound(low, last, to);
    if (low == high) return;
    probe_.code[0] = with;
    scan_range(probe_, 0, columns_, static_cast<std::size_t>(low - lo.begin()),
               static_cast<std::size_t>(high - lo.begin()), sink);
  });
}

void LevelGrid::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  if (begin_.empty()) return;
  require(begin_.front() == 0 && begin_.back() == columns_.size, "grid: columns do not cover the entries");
  for (std::size_t c = 0; c + 1 < begin_.size(); ++c) {
    require(begin_[c] <= begin_[c + 1], "grid: columns overlap");
    for (std::size_t i = begin_[c] + 1; i < begin_[c + 1]; ++i)
      require(columns_.lo[0][i - 1] <= columns_.lo[0][i], "grid: a column is out of order");
  }
}

std::size_t LevelGrid::memory_bytes() const {
  return columns_.memory_bytes() + probe_.memory_bytes() + spans_.capacity() * sizeof(Span) +
         (begin_.capacity() + entered_slots_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace touchstone::broad
