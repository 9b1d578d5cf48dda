#include "tests/bench/plain_kernel.h"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/plain_kernel.cpp"
#include <hwy/foreach_target.h>  // includes this file once per instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace touchstone::bench::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using F = hn::ScalableTag<float>;
using U = hn::RebindToUnsigned<F>;

void sweep(const PlainColumns& b, std::size_t begin, std::size_t end, std::vector<broad::IdPair>& out,
           std::size_t& n) {
  const F f;
  const U u;
  const std::size_t lanes = hn::Lanes(f);
  const auto index = hn::Set(u, 0x3fffffff), owned = hn::Set(u, 0xc0000000);
  for (std::size_t i = begin; i + 1 < end; ++i) {
    const auto x1 = hn::Set(f, b.c[3][i]), y0 = hn::Set(f, b.c[1][i]), y1 = hn::Set(f, b.c[4][i]),
               z0 = hn::Set(f, b.c[2][i]), z1 = hn::Set(f, b.c[5][i]);
    const auto mine = hn::Set(u, b.code[i]);
    if (out.size() < n + end - i + lanes) out.resize(2 * out.size() + end - i + lanes);
    for (std::size_t j = i + 1; j < end; j += lanes) {
      const auto in = hn::RebindMask(f, hn::FirstN(u, end - j));
      const auto begun = hn::And(in, hn::Le(hn::LoadU(f, &b.c[0][j]), x1));
      const auto theirs = hn::LoadU(u, &b.code[j]);
      auto hit =
          hn::And(begun, hn::And(hn::Le(hn::LoadU(f, &b.c[1][j]), y1), hn::Le(y0, hn::LoadU(f, &b.c[4][j]))));
      hit = hn::And(hit, hn::And(hn::Le(hn::LoadU(f, &b.c[2][j]), z1), hn::Le(z0, hn::LoadU(f, &b.c[5][j]))));
      const auto own = hn::Eq(hn::And(hn::Or(theirs, mine), owned), owned);
      const auto kept = hn::And(hn::RebindMask(u, hit), own);
      const auto a = hn::And(theirs, index), c = hn::And(mine, index);
      // Not hn::Compress: with g++ 12 on AVX2 it copies a 1 KB table on every call.
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(u, kept, bits);
      std::uint32_t left = bits[0] | static_cast<std::uint32_t>(bits[1]) << 8;
      if (left == 0 && hn::AllTrue(f, begun)) continue;
      HWY_ALIGN std::uint32_t first[hn::MaxLanes(u)], second[hn::MaxLanes(u)];
      hn::Store(hn::Min(a, c), u, first);
      hn::Store(hn::Max(a, c), u, second);
      for (; left != 0; left &= left - 1, ++n) {
        const auto k = static_cast<std::size_t>(__builtin_ctz(left));
        out[n] = {static_cast<int>(first[k]), static_cast<int>(second[k])};
      }
      if (!hn::AllTrue(f, begun)) break;
    }
  }
}

}  // namespace
}  // namespace touchstone::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace touchstone::bench {

HWY_EXPORT(sweep);

std::uint32_t plain_key(float f) {
  const auto b = std::bit_cast<std::uint32_t>(f);
  return (b >> 31) != 0 ? ~b : b | 0x80000000U;
}

void plain_radix_sort(std::vector<PlainItem>& items, std::vector<PlainItem>& scratch) {
  scratch.resize(items.size());
  std::array<std::array<std::uint32_t, 2048>, 3> count{};
  for (const PlainItem& i : items) {
    ++count[0][i.key & 2047];
    ++count[1][i.key >> 11 & 2047];
    ++count[2][i.key >> 22];
  }
  for (std::size_t d = 0; d < 3; ++d) {
    std::uint32_t sum = 0;
    for (auto& c : count[d]) {
      const std::uint32_t here = c;
      c = sum;
      sum += here;
    }
    for (const PlainItem& i : items) scratch[count[d][i.key >> (11 * d) & 2047]++] = i;
    items.swap(scratch);
  }
}

void PlainColumns::resize(std::size_t n) {
  constexpr std::size_t beyond = 64;
  if (code.size() < n + beyond) {
    for (auto& column : c) column.resize(n + n / 4 + beyond);
    code.resize(n + n / 4 + beyond);
  }
  for (std::size_t i = n; i < n + beyond; ++i) c[0][i] = 3e38F;
}

void PlainColumns::put(std::size_t at, const Aabb& b, std::uint32_t with_code) {
  for (int k = 0; k < 3; ++k) {
    c[static_cast<std::size_t>(k)][at] = static_cast<float>(b.lo[k]);
    c[static_cast<std::size_t>(k) + 3][at] = static_cast<float>(b.hi[k]);
  }
  code[at] = with_code;
}

void plain_sweep_range(const PlainColumns& boxes, std::size_t begin, std::size_t end,
                       std::vector<broad::IdPair>& out, std::size_t& n) {
  HWY_DYNAMIC_DISPATCH(sweep)(boxes, begin, end, out, n);
}

}  // namespace touchstone::bench
#endif
