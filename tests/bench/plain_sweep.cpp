// The honest competitor: what an afternoon gives. Each frame from nothing: radix sort of the double boxes by
// their lower x, then a sweep whose inner loop the compiler may vectorise; nothing is remembered, no grid, no
// output order.
#include <algorithm>
#include <array>
#include <bit>

#include "tests/bench/broad_scenes.h"

namespace touchstone::bench {
namespace {

struct Item {
  std::uint32_t key, box;
};

std::uint32_t sortable(float f) {
  const auto b = std::bit_cast<std::uint32_t>(f);
  return (b >> 31) != 0 ? ~b : b | 0x80000000U;
}

class PlainSweep final : public Contestant {
 public:
  void start(const std::vector<Aabb>& boxes) override { boxes_ = boxes; }
  void frame(const std::vector<broad::BoxUpdate>& moves, std::vector<broad::IdPair>& out) override {
    for (const broad::BoxUpdate& m : moves) boxes_[static_cast<std::size_t>(m.id)] = m.box;
    sort();
    gather();
    out.clear();
    for (std::size_t i = 0; i < order_.size(); ++i) sweep(i, out);
  }

 private:
  static constexpr std::size_t block = 16;
  void sort() {
    order_.resize(boxes_.size()), scratch_.resize(boxes_.size());
    std::array<std::array<std::uint32_t, 2048>, 3> count{};
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const std::uint32_t k = sortable(static_cast<float>(boxes_[i].lo.x()));
      order_[i] = {k, static_cast<std::uint32_t>(i)};
      ++count[0][k & 2047], ++count[1][k >> 11 & 2047], ++count[2][k >> 22];
    }
    for (std::size_t d = 0; d < 3; ++d) {
      std::uint32_t sum = 0;
      for (auto& c : count[d]) {
        const std::uint32_t here = c;
        c = sum, sum += here;
      }
      for (const Item& i : order_) scratch_[count[d][i.key >> (11 * d) & 2047]++] = i;
      order_.swap(scratch_);
    }
  }
  void gather() {
    for (auto& c : columns_) c.resize(boxes_.size() + block);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const Aabb& b = boxes_[order_[i].box];
      for (int k = 0; k < 3; ++k) {
        columns_[static_cast<std::size_t>(k)][i] = static_cast<float>(b.lo[k]);
        columns_[static_cast<std::size_t>(k) + 3][i] = static_cast<float>(b.hi[k]);
      }
    }
    for (std::size_t i = order_.size(); i < order_.size() + block; ++i) columns_[0][i] = 3e38F;
  }
  void sweep(std::size_t i, std::vector<broad::IdPair>& out) const {
    const float hx = columns_[3][i], ly = columns_[1][i], hy = columns_[4][i], lz = columns_[2][i],
                hz = columns_[5][i];
    const float *x = columns_[0].data(), *y0 = columns_[1].data(), *z0 = columns_[2].data(),
                *y1 = columns_[4].data(), *z1 = columns_[5].data();
    for (std::size_t j = i + 1; x[j] <= hx; j += block) {
      std::uint8_t hit[block];
      std::uint8_t any = 0;
      for (std::size_t k = 0; k < block; ++k)
        hit[k] = static_cast<std::uint8_t>((x[j + k] <= hx) & (y0[j + k] <= hy) & (ly <= y1[j + k]) &
                                           (z0[j + k] <= hz) & (lz <= z1[j + k]));
      for (std::size_t k = 0; k < block; ++k) any |= hit[k];
      if (any == 0) continue;
      for (std::size_t k = 0; k < block; ++k)
        if (hit[k] != 0) {
          const auto a = static_cast<int>(order_[i].box), b = static_cast<int>(order_[j + k].box);
          out.push_back({std::min(a, b), std::max(a, b)});
        }
    }
  }
  std::vector<Aabb> boxes_;
  std::vector<Item> order_, scratch_;
  std::array<std::vector<float>, 6> columns_;
};

}  // namespace

std::unique_ptr<Contestant> make_plain_sweep() { return std::make_unique<PlainSweep>(); }

}  // namespace touchstone::bench
