#include "core/broad/pair_kernels.h"

#include "core/broad/release.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/broad/pair_kernels.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each kind of processor
#include <hwy/highway.h>

#include "core/broad/pack_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace touchstone::broad::HWY_NAMESPACE {
namespace {

using I = hn::ScalableTag<std::int32_t>;
using V = hn::Vec<I>;
using M = hn::Mask<I>;

// Highway 1.0 has no <= for integers.
HWY_INLINE M at_most(V a, V b) { return hn::Not(hn::Gt(a, b)); }

// One box, broadcast to all lanes.
struct Probe {
  V lo[3], hi[3], code;
  HWY_INLINE Probe(const BoxColumns& b, std::size_t i) {
    const I d;
    for (int k = 0; k < 3; ++k) {
      lo[k] = hn::Set(d, b.lo[k][i]);
      hi[k] = hn::Set(d, b.hi[k][i]);
    }
    code = hn::Set(d, static_cast<std::int32_t>(b.code[i]));
  }
  HWY_INLINE M apart(const BoxColumns& b, std::size_t j, int axis) const {
    const I d;
    return hn::Or(hn::Gt(hn::LoadU(d, b.lo[axis].data() + j), hi[axis]),
                  hn::Gt(lo[axis], hn::LoadU(d, b.hi[axis].data() + j)));
  }
  // A margin of two keys on each side of each axis: the doubles certainly overlap (float_key.h).
  HWY_INLINE M certain(const BoxColumns& b, std::size_t j) const {
    const I d;
    const V two = hn::Set(d, 2);
    M m = hn::FirstN(d, hn::Lanes(d));
    for (int k = 0; k < 3; ++k) {
      const V blo = hn::LoadU(d, b.lo[k].data() + j), bhi = hn::LoadU(d, b.hi[k].data() + j);
      m = hn::And(m, hn::And(at_most(hn::Add(blo, two), hi[k]), at_most(hn::Add(lo[k], two), bhi)));
    }
    return m;
  }
  HWY_INLINE M counts(const BoxColumns& b, std::size_t j) const {
    const I d;
    const V flags = hn::Set(d, static_cast<std::int32_t>(owner_flags | moving_flag));
    const V theirs = hn::LoadU(d, reinterpret_cast<const std::int32_t*>(b.code.data()) + j);
    return hn::Eq(hn::And(hn::Or(theirs, code), flags), flags);
  }
};

HWY_NOINLINE void emit_doubtful(const BoxColumns& b, std::size_t j, std::uint32_t mine, M m, PairSink& sink) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(I{}, m, bits);
  for (std::size_t lane = 0; lane < hn::Lanes(I{}); ++lane)
    if ((bits[lane / 8] >> (lane % 8) & 1) != 0) {
      const std::uint32_t other = b.code[j + lane] & slot_mask, self = mine & slot_mask;
      sink.doubtful.push_back({self < other ? self : other, self < other ? other : self});
    }
}

HWY_INLINE void emit(const BoxColumns& b, std::size_t j, std::uint32_t mine, const Probe& p, M hit,
                     PairSink& sink) {
  const I d;
  const M certain = p.certain(b, j), doubt = hn::AndNot(certain, hit), sure = hn::And(hit, certain);
  if (HWY_UNLIKELY(!hn::AllFalse(d, doubt))) emit_doubtful(b, j, mine, doubt, sink);
  sink.reserve(hn::Lanes(d));
  const V mask = hn::Set(d, static_cast<std::int32_t>(slot_mask));
  const V theirs = hn::And(hn::LoadU(d, reinterpret_cast<const std::int32_t*>(b.code.data()) + j), mask);
  const V self = hn::And(p.code, mask);
  const Packer pack(sure);
  hn::StoreU(pack(hn::Min(theirs, self)), d, reinterpret_cast<std::int32_t*>(sink.first.data()) + sink.n);
  hn::StoreU(pack(hn::Max(theirs, self)), d, reinterpret_cast<std::int32_t*>(sink.second.data()) + sink.n);
  sink.n += pack.count();
}

void sweep(const BoxColumns& b, std::size_t first, std::size_t last, PairSink& sink) {
  const I d;
  const std::size_t lanes = hn::Lanes(d), end = b.size;
  for (std::size_t i = first; i < last && i + 1 < end; ++i) {
    if (b.lo[0][i + 1] > b.hi[0][i]) continue;
    const Probe p(b, i);
    for (std::size_t j = i + 1; j < end; j += lanes) {
      // lo[0] ascends, so a later box that begins before box i ends overlaps it on this axis. The padding
      // after the last box is beyond every box's end.
      const M later = hn::Gt(hn::LoadU(d, b.lo[0].data() + j), p.hi[0]);
      const M hit = hn::AndNot(hn::Or(later, hn::Or(p.apart(b, j, 1), p.apart(b, j, 2))), p.counts(b, j));
      if (!hn::AllFalse(d, hit)) emit(b, j, b.code[i], p, hit, sink);
      if (!hn::AllFalse(d, later)) break;
    }
  }
}

void scan(const BoxColumns& from, std::size_t i, const BoxColumns& b, std::size_t begin, std::size_t end,
          PairSink& sink) {
  const I d;
  const std::size_t lanes = hn::Lanes(d);
  const Probe p(from, i);
  for (std::size_t j = begin; j < end; j += lanes) {
    const M in = hn::And(hn::FirstN(d, end - j), p.counts(b, j));
    const M hit = hn::AndNot(hn::Or(p.apart(b, j, 0), hn::Or(p.apart(b, j, 1), p.apart(b, j, 2))), in);
    if (!hn::AllFalse(d, hit)) emit(b, j, from.code[i], p, hit, sink);
  }
}

std::uint32_t mask_16(const BoxColumns& from, std::size_t i, const BoxColumns& b, std::size_t begin) {
  const I d;
  const std::size_t lanes = hn::Lanes(d);
  const Probe p(from, i);
  std::uint32_t all = 0;
  for (std::size_t j = 0; j < 16; j += lanes) {
    const M hit =
        hn::Not(hn::Or(p.apart(b, begin + j, 0), hn::Or(p.apart(b, begin + j, 1), p.apart(b, begin + j, 2))));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hit, bits);
    all |= (bits[0] | static_cast<std::uint32_t>(bits[1]) << 8) << j;
  }
  return all & 0xffff;
}

}  // namespace
}  // namespace touchstone::broad::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace touchstone::broad {

HWY_EXPORT(sweep);
HWY_EXPORT(scan);
HWY_EXPORT(mask_16);

void BoxColumns::resize(std::size_t n) {
  size = n;
  for (int k = 0; k < 3; ++k) {
    if (lo[k].size() < n + padding) {
      resize_exactly(lo[k], n + n / 16 + padding);
      resize_exactly(hi[k], n + n / 16 + padding);
    }
    for (std::size_t j = n; j < n + padding; ++j) {
      lo[k][j] = no_key;
      hi[k][j] = -no_key;
    }
  }
  if (code.size() < n + padding) resize_exactly(code, n + n / 16 + padding);
}

void BoxColumns::gather(const BoxStore& store, int first_axis) {
  const KeyBox* const keys = store.keys().data();
  const int a = first_axis, b = (a + 1) % 3, c = (a + 2) % 3;
  for (std::size_t i = 0; i < size; ++i) {
    const KeyBox& k = keys[code[i] & slot_mask];
    lo[0][i] = k.lo[a];
    hi[0][i] = k.hi[a];
    lo[1][i] = k.lo[b];
    hi[1][i] = k.hi[b];
    lo[2][i] = k.lo[c];
    hi[2][i] = k.hi[c];
  }
}

void sweep_range(const BoxColumns& boxes, std::size_t begin, std::size_t end, PairSink& sink) {
  HWY_DYNAMIC_DISPATCH(sweep)(boxes, begin, end, sink);
}

void sweep_all(const BoxColumns& boxes, PairSink& sink) {
  const std::size_t parts = sink.parts(boxes.size);
  sink.in_parts(parts, [&](std::size_t p, PairSink& out) {
    deal_chunks(boxes.size, 256, parts, p,
                [&](std::size_t begin, std::size_t end) { sweep_range(boxes, begin, end, out); });
  });
}

void scan_range(const BoxColumns& from, std::size_t i, const BoxColumns& boxes, std::size_t begin,
                std::size_t end, PairSink& sink) {
  HWY_DYNAMIC_DISPATCH(scan)(from, i, boxes, begin, end, sink);
}

std::uint32_t overlap_mask_16(const BoxColumns& from, std::size_t i, const BoxColumns& boxes,
                              std::size_t begin) {
  return HWY_DYNAMIC_DISPATCH(mask_16)(from, i, boxes, begin);
}

}  // namespace touchstone::broad
#endif
