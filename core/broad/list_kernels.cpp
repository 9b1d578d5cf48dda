#include "core/broad/list_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/broad/list_kernels.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each kind of processor
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace touchstone::broad::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Sorts the partners of one box: a handful in most scenes.
HWY_INLINE void sort_few(const std::uint32_t* from, std::size_t n, std::uint32_t* to) {
  constexpr std::size_t max_insertion_sort = 24;
  if (n > max_insertion_sort) {
    std::copy_n(from, n, to);
    std::sort(to, to + n);
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t v = from[i];
    std::size_t j = i;
    for (; j > 0 && v < to[j - 1]; --j) to[j] = to[j - 1];
    to[j] = v;
  }
}

// Eight lanes: AVX2 and better targets, which have lower numbers in Highway.
#if !(HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2)
constexpr bool wide = false;

HWY_INLINE void sort_eight(const std::uint32_t*, std::size_t, std::uint32_t*) {}
HWY_INLINE void write_eight(const std::uint32_t*, std::size_t, std::uint32_t, IdPair*) {}
#else
constexpr bool wide = true;
using U = hn::CappedTag<std::uint32_t, 8>;
using V = hn::Vec<U>;

// Bitonic sort (Batcher 1968) of eight lanes. The number of partners of a box cannot be predicted, and a
// misprediction costs as much as these six steps.
template <int distance>
HWY_INLINE V partner(V v) {
  if constexpr (distance == 1) return hn::Shuffle2301(v);
  if constexpr (distance == 2) return hn::Shuffle1032(v);
  alignas(32) static constexpr std::uint32_t across[8] = {4, 5, 6, 7, 0, 1, 2, 3};
  return hn::TableLookupLanes(v, hn::SetTableIndices(U(), across));
}

template <int run, int distance>
HWY_INLINE V step(V v) {
  alignas(32) static constexpr std::uint32_t lane[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const U d;
  const V at = hn::Load(d, lane);
  const auto low = hn::Eq(hn::And(at, hn::Set(d, distance)), hn::Zero(d));
  const auto up = hn::Eq(hn::And(at, hn::Set(d, run)), hn::Zero(d));
  const V p = partner<distance>(v);
  return hn::IfThenElse(hn::Xor(low, up), hn::Max(v, p), hn::Min(v, p));
}

HWY_INLINE V sorted_eight(const std::uint32_t* from, std::size_t n) {
  const U d;
  V v = hn::IfThenElse(hn::FirstN(d, n), hn::LoadU(d, from), hn::Set(d, 0xffffffff));
  v = step<2, 1>(v);
  v = step<4, 1>(step<4, 2>(v));
  return step<8, 1>(step<8, 2>(step<8, 4>(v)));
}

HWY_INLINE void sort_eight(const std::uint32_t* from, std::size_t n, std::uint32_t* to) {
  hn::StoreU(sorted_eight(from, n), U(), to);
}

HWY_INLINE void write_eight(const std::uint32_t* from, std::size_t n, std::uint32_t bucket, IdPair* out) {
  hn::StoreInterleaved2(hn::Set(U(), bucket), sorted_eight(from, n), U(),
                        reinterpret_cast<std::uint32_t*>(out));
}
#endif

// Always writes eight elements: those beyond the bucket are overwritten by the following buckets. Near the
// end, sort_few writes exactly the bucket.
void sort(const std::uint32_t* end, std::size_t from, std::size_t to, const std::uint32_t* second,
          std::uint32_t* sorted) {
  const std::size_t all = to > from ? end[to - 1] : 0;
  std::uint32_t begin = from > 0 ? end[from - 1] : 0;
  for (std::size_t s = from; s < to; begin = end[s], ++s) {
    const std::size_t n = end[s] - begin;
    if (wide && HWY_LIKELY((n <= 8) & (begin + 8 <= all)))
      sort_eight(second + begin, n, sorted + begin);
    else
      sort_few(second + begin, n, sorted + begin);
  }
}

void write(const std::uint32_t* end, std::size_t from, std::size_t to, const std::uint32_t* second,
           IdPair* out) {
  const std::size_t all = to > from ? end[to - 1] : 0;
  std::uint32_t begin = from > 0 ? end[from - 1] : 0;
  std::vector<std::uint32_t> few;
  for (std::size_t s = from; s < to; begin = end[s], ++s) {
    const std::size_t n = end[s] - begin;
    if (wide && HWY_LIKELY((n <= 8) & (begin + 8 <= all))) {
      write_eight(second + begin, n, static_cast<std::uint32_t>(s), out + begin);
    } else if (n > 0) {
      few.resize(std::max(few.size(), n));
      sort_few(second + begin, n, few.data());
      for (std::size_t k = 0; k < n; ++k) out[begin + k] = {static_cast<int>(s), static_cast<int>(few[k])};
    }
  }
}

#if HWY_TARGET == HWY_SCALAR
struct Apart {
  bool apart, doubtful;
};
HWY_INLINE Apart compare(const KeyBox& a, const KeyBox& b) {
  Apart r{false, false};
  for (int k = 0; k < 3; ++k) {
    r.apart |= b.lo[k] > a.hi[k] || a.lo[k] > b.hi[k];
    r.doubtful |= b.lo[k] > a.hi[k] - 2 || a.lo[k] + 2 > b.hi[k];
  }
  return r;
}
HWY_INLINE bool inside(const KeyBox& a, const KeyBox& fat) {
  bool in = true;
  for (int k = 0; k < 3; ++k) in &= a.lo[k] >= fat.lo[k] && a.hi[k] <= fat.hi[k];
  return in;
}
#else
using I4 = hn::FixedTag<std::int32_t, 4>;
struct Apart {
  bool apart, doubtful;
};
HWY_INLINE Apart compare(const KeyBox& a, const KeyBox& b) {
  alignas(16) static constexpr std::int32_t margin[4] = {2, 2, 2, 0};
  const I4 d;
  const auto a_lo = hn::Load(d, a.lo), a_hi = hn::Load(d, a.hi), b_lo = hn::Load(d, b.lo),
             b_hi = hn::Load(d, b.hi);
  const auto two = hn::Load(d, margin);
  return {!hn::AllFalse(d, hn::Or(hn::Gt(b_lo, a_hi), hn::Gt(a_lo, b_hi))),
          !hn::AllFalse(d, hn::Or(hn::Gt(b_lo, hn::Sub(a_hi, two)), hn::Gt(hn::Add(a_lo, two), b_hi)))};
}
HWY_INLINE bool inside(const KeyBox& a, const KeyBox& fat) {
  const I4 d;
  // The fourth lane of a fat box holds other data.
  const auto out = hn::And(
      hn::Or(hn::Gt(hn::Load(d, fat.lo), hn::Load(d, a.lo)), hn::Gt(hn::Load(d, a.hi), hn::Load(d, fat.hi))),
      hn::FirstN(d, 3));
  return hn::AllFalse(d, out);
}
#endif

// The first slot of each candidate, for as many boxes as fit. The number of candidates of a box cannot be
// predicted; up to one vector of them takes one store.
struct Firsts {
  static constexpr std::size_t most = 512;
  std::uint32_t of[most + 64];
  // Fills in boxes [from, result).
  HWY_INLINE std::size_t spread(const std::uint32_t* end, std::size_t from, std::size_t to,
                                std::size_t begin) {
    const hn::ScalableTag<std::uint32_t> d;
    std::size_t n = 0, s = from;
    for (; s < to; ++s) {
      const std::size_t mine = end[s] - begin;
      if (HWY_UNLIKELY(n + mine > most)) break;
      std::size_t k = 0;
      do {
        hn::StoreU(hn::Set(d, static_cast<std::uint32_t>(s)), d, of + n + k);
        k += hn::Lanes(d);
      } while (HWY_UNLIKELY(k < mine));
      n += mine;
      begin = end[s];
    }
    return s;
  }
};

HWY_INLINE std::size_t filter_one(const KeyBox* keys, const Aabb* boxes, std::uint32_t s, std::uint32_t t,
                                  IdPair* out) {
  const Apart r = compare(keys[s], keys[t]);
  *out = {static_cast<int>(s), static_cast<int>(t)};
  // A single branch, which is rarely taken: a third of the candidates are apart, unpredictably, and those are
  // also "doubtful". The empty asm statement keeps the compiler from splitting the branch in two (measured:
  // 40 % of this loop, 2026-11-21, Zen 3).
  unsigned state = (r.apart ? 2U : 0U) | (r.doubtful ? 1U : 0U);
  asm volatile("" : "+r"(state));
  if (HWY_UNLIKELY(state == 1)) return overlaps(boxes[s], boxes[t]) ? 1 : 0;
  return 1 - (state >> 1);
}

std::size_t filter(const KeyBox* keys, const Aabb* boxes, const std::uint32_t* end,
                   const std::uint32_t* second, std::size_t from, std::size_t to, IdPair* out) {
  constexpr std::size_t ahead = 12;
  static_assert(ahead <= list_padding);
  Firsts firsts;
  std::size_t n = 0, c = from > 0 ? end[from - 1] : 0;
  while (from < to) {
    const std::size_t next = firsts.spread(end, from, to, c);
    if (HWY_UNLIKELY(next == from)) {  // one box with more candidates than fit
      for (; c < end[from]; ++c)
        n += filter_one(keys, boxes, static_cast<std::uint32_t>(from), second[c], out + n);
      ++from;
      continue;
    }
    const std::size_t last = end[next - 1];
    for (const std::uint32_t* first = firsts.of; c < last; ++c, ++first) {
      __builtin_prefetch(&keys[second[c + ahead]]);
      n += filter_one(keys, boxes, *first, second[c], out + n);
    }
    from = next;
  }
  return n;
}

void escapes(const KeyBox* keys, const KeyBox* fat, const std::uint32_t* slots, std::size_t n,
             std::vector<std::uint32_t>& escaped) {
  for (std::size_t i = 0; i < n; ++i)
    if (HWY_UNLIKELY(!inside(keys[slots[i]], fat[slots[i]]))) escaped.push_back(slots[i]);
}

}  // namespace
}  // namespace touchstone::broad::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace touchstone::broad {

HWY_EXPORT(sort);
HWY_EXPORT(write);
HWY_EXPORT(filter);
HWY_EXPORT(escapes);

void sort_buckets(const std::uint32_t* end, std::size_t from, std::size_t to, const std::uint32_t* second,
                  std::uint32_t* sorted) {
  HWY_DYNAMIC_DISPATCH(sort)(end, from, to, second, sorted);
}

void write_buckets(const std::uint32_t* end, std::size_t from, std::size_t to, const std::uint32_t* second,
                   IdPair* out) {
  HWY_DYNAMIC_DISPATCH(write)(end, from, to, second, out);
}

std::size_t filter_candidates(const KeyBox* keys, const Aabb* boxes, const std::uint32_t* end,
                              const std::uint32_t* second, std::size_t from, std::size_t to, IdPair* out) {
  return HWY_DYNAMIC_DISPATCH(filter)(keys, boxes, end, second, from, to, out);
}

void find_escapes(const KeyBox* keys, const KeyBox* fat, std::span<const std::uint32_t> slots,
                  std::vector<std::uint32_t>& escaped) {
  HWY_DYNAMIC_DISPATCH(escapes)(keys, fat, slots.data(), slots.size(), escaped);
}

}  // namespace touchstone::broad
#endif
