// The honest competitors: what can be written in an afternoon. Every frame starts from scratch and keeps no
// state; pairs are unordered, boxes are rounded to the nearest float (so a touching pair may be lost).
//   plain_sweep   radix sort of the boxes by lower x, one wide sweep
//   plain_grid    the same in columns of cells in y and z: each box is entered in every column that it meets,
//                 each column is swept along x, a pair is kept in the column of its larger lower cells. It is
//                 given the size of the usual box, which a user knows; cells are 2.5 times as wide (measured:
//                 best of 1.5, 2, 2.5, 3, 4 at uniform 1e4, 1e5).
//   ..._sorted    the same, with the pairs sorted by two radix sorts, as our interface reports them.
#include <algorithm>
#include <cmath>

#include "tests/bench/broad_scenes.h"
#include "tests/bench/plain_kernel.h"

namespace touchstone::bench {
namespace {

class Plain : public Contestant {
 public:
  void start(const std::vector<Aabb>& boxes) override { boxes_ = boxes; }
  void frame(const std::vector<broad::BoxUpdate>& moves, std::vector<broad::IdPair>& out) override {
    for (const broad::BoxUpdate& m : moves) boxes_[static_cast<std::size_t>(m.id)] = m.box;
    order_.resize(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      order_[i] = {plain_key(static_cast<float>(boxes_[i].lo.x())), static_cast<std::uint32_t>(i)};
    plain_radix_sort(order_, scratch_);
    std::size_t n = 0;
    out.resize(std::max(out.capacity(), 2 * boxes_.size()));
    find(out, n);
    out.resize(n);
  }

 protected:
  virtual void find(std::vector<broad::IdPair>& out, std::size_t& n) = 0;
  std::vector<Aabb> boxes_;
  std::vector<PlainItem> order_, scratch_;
  PlainColumns columns_;
};

class PlainSweep final : public Plain {
  void find(std::vector<broad::IdPair>& out, std::size_t& n) override {
    columns_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i)
      columns_.put(i, boxes_[order_[i].box], order_[i].box | 0xc0000000U);
    plain_sweep_range(columns_, 0, order_.size(), out, n);
  }
};

class PlainGrid final : public Plain {
  struct Span {
    std::uint32_t y0, y1, z0, z1;
  };
  static constexpr double usual_box = 1, cells_wide = 2.5;
  std::uint32_t cell(double x, int k) const {
    return static_cast<std::uint32_t>(std::clamp((x - low_[k]) * scale_[k], 0.0, count_[k] - 1.0));
  }
  void choose_cells() {
    Aabb world;
    for (const Aabb& b : boxes_) world.extend(b);
    double cells = 1;
    for (int k = 1; k < 3; ++k) {
      low_[k] = world.lo[k];
      count_[k] = std::max(1.0, std::floor((world.hi[k] - world.lo[k]) / (usual_box * cells_wide)));
      cells *= count_[k];
    }
    // No more columns than boxes.
    const double shrink = std::max(1.0, std::sqrt(cells / static_cast<double>(boxes_.size())));
    for (int k = 1; k < 3; ++k) {
      count_[k] = std::max(1.0, std::floor(count_[k] / shrink));
      scale_[k] = count_[k] / (world.hi[k] - world.lo[k]);
    }
  }
  void find(std::vector<broad::IdPair>& out, std::size_t& n) override {
    choose_cells();
    const auto ny = static_cast<std::uint32_t>(count_[1]), nz = static_cast<std::uint32_t>(count_[2]);
    begin_.assign(std::size_t{ny} * nz + 1, 0);
    spans_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const Aabb& b = boxes_[order_[i].box];
      const Span s{cell(b.lo.y(), 1), cell(b.hi.y(), 1), cell(b.lo.z(), 2), cell(b.hi.z(), 2)};
      spans_[i] = s;
      for (std::uint32_t y = s.y0; y <= s.y1; ++y)
        for (std::uint32_t z = s.z0; z <= s.z1; ++z) ++begin_[y * nz + z];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& b : begin_) {
      sum += b;
      b = sum;
    }
    columns_.resize(sum);
    for (std::size_t i = order_.size(); i-- > 0;) {
      const Span& s = spans_[i];
      for (std::uint32_t y = s.y0; y <= s.y1; ++y)
        for (std::uint32_t z = s.z0; z <= s.z1; ++z)
          columns_.put(--begin_[y * nz + z], boxes_[order_[i].box],
                       order_[i].box | (y == s.y0 ? 0x80000000U : 0) | (z == s.z0 ? 0x40000000U : 0));
    }
    for (std::size_t c = 0; c + 1 < begin_.size(); ++c)
      plain_sweep_range(columns_, begin_[c], begin_[c + 1], out, n);
  }
  double low_[3] = {}, scale_[3] = {}, count_[3] = {1, 1, 1};
  std::vector<std::uint32_t> begin_;
  std::vector<Span> spans_;
};

template <class P>
class Sorted final : public Contestant {
 public:
  void start(const std::vector<Aabb>& boxes) override { plain_.start(boxes); }
  void frame(const std::vector<broad::BoxUpdate>& moves, std::vector<broad::IdPair>& out) override {
    plain_.frame(moves, found_);
    const auto n = static_cast<std::uint32_t>(found_.size());
    items_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) items_[i] = {static_cast<std::uint32_t>(found_[i].second), i};
    plain_radix_sort(items_, scratch_);
    for (PlainItem& item : items_) item.key = static_cast<std::uint32_t>(found_[item.box].first);
    plain_radix_sort(items_, scratch_);
    out.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) out[i] = found_[items_[i].box];
  }

 private:
  P plain_;
  std::vector<broad::IdPair> found_;
  std::vector<PlainItem> items_, scratch_;
};

// Not a broad phase but the lower bound on its work: stream the boxes, radix-sort n keys, gather the boxes in
// that order, write as many pairs as there are. Reports no pairs.
class Bound final : public Contestant {
 public:
  explicit Bound(std::size_t pairs) : pairs_(pairs) {}
  void start(const std::vector<Aabb>& boxes) override { boxes_ = boxes; }
  void frame(const std::vector<broad::BoxUpdate>&, std::vector<broad::IdPair>& out) override {
    order_.resize(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      order_[i] = {plain_key(static_cast<float>(boxes_[i].lo.x())), static_cast<std::uint32_t>(i)};
    plain_radix_sort(order_, scratch_);
    columns_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) columns_.put(i, boxes_[order_[i].box], order_[i].box);
    out.resize(pairs_);
    for (std::size_t i = 0; i < pairs_; ++i) out[i] = {static_cast<int>(i), static_cast<int>(i + 1)};
  }
  bool answers() const override { return false; }

 private:
  std::size_t pairs_;
  std::vector<Aabb> boxes_;
  std::vector<PlainItem> order_, scratch_;
  PlainColumns columns_;
};

}  // namespace

std::unique_ptr<Contestant> make_plain_sweep() { return std::make_unique<PlainSweep>(); }
std::unique_ptr<Contestant> make_plain_grid() { return std::make_unique<PlainGrid>(); }
std::unique_ptr<Contestant> make_plain_sweep_sorted() { return std::make_unique<Sorted<PlainSweep>>(); }
std::unique_ptr<Contestant> make_plain_grid_sorted() { return std::make_unique<Sorted<PlainGrid>>(); }
std::unique_ptr<Contestant> make_bound(std::size_t pairs) { return std::make_unique<Bound>(pairs); }

}  // namespace touchstone::bench
