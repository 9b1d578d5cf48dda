#include "core/broad/pair_kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/broad/box_kernels.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each kind of processor
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace touchstone::broad::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(sizeof(Aabb) == 6 * sizeof(double));

// Cap on the change of a coordinate, so that it is finite in float.
constexpr double largest_step = 1e30;

// Four doubles or eight keys at once: AVX2 and better targets, which have lower numbers in Highway.
#if !(HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2)
HWY_INLINE void put(const Aabb& box, Aabb& old, KeyBox& key, float& step) {
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    const double lo = std::abs(box.lo[k] - old.lo[k]), hi = std::abs(box.hi[k] - old.hi[k]);
    most = lo > most ? lo : most;
    most = hi > most ? hi : most;
  }
  step = static_cast<float>(std::min(most, largest_step));
  key = key_box(box);
  old = box;
}
#else
using D = hn::FixedTag<double, 4>;
using I = hn::FixedTag<std::int32_t, 4>;
using Doubles = hn::Vec<D>;
using Keys = hn::Vec<I>;

// key_below of float_key.h for sign −1, key_above for sign 1.
template <int sign>
HWY_INLINE Keys outward(Doubles x) {
  const D d;
  const I i;
  const hn::FixedTag<float, 4> f;
  const auto nearest = hn::DemoteTo(f, x);
  const Doubles back = hn::PromoteTo(d, nearest);
  const auto inward = sign < 0 ? hn::Gt(back, x) : hn::Lt(back, x);
  const Keys one = hn::DemoteTo(i, hn::IfThenElseZero(inward, hn::Set(d, static_cast<double>(sign))));
  const Keys bits = hn::BitCast(i, nearest), negative = hn::ShiftRight<31>(bits);
  const Keys size = hn::And(bits, hn::Set(i, 0x7fffffff));
  return hn::Add(hn::Sub(hn::Xor(size, negative), negative), one);
}

HWY_INLINE Doubles change(Doubles a, Doubles b) {
  const Doubles c = hn::Abs(hn::Sub(a, b));
  return hn::IfThenElseZero(hn::Eq(c, c), c);
}

// Two overlapping loads: lo x y z, hi x; lo z, hi x y z.
HWY_INLINE void put(const Aabb& box, Aabb& old, KeyBox& key, float& step) {
  const D d;
  const I i;
  const double* const from = box.lo.data();
  double* const to = old.lo.data();
  const Doubles lo = hn::LoadU(d, from), hi = hn::LoadU(d, from + 2);
  const Doubles most = hn::Max(change(lo, hn::LoadU(d, to)), change(hi, hn::LoadU(d, to + 2)));
  step = static_cast<float>(std::min(hn::GetLane(hn::MaxOfLanes(d, most)), largest_step));
  hn::StoreU(lo, d, to);
  hn::StoreU(hi, d, to + 2);
  const auto three = hn::FirstN(i, 3);
  hn::Store(hn::IfThenElseZero(three, outward<-1>(lo)), i, key.lo);
  hn::Store(hn::IfThenElseZero(three, hn::Shuffle0321(outward<1>(hi))), i, key.hi);
}
#endif

void put_all(const BoxUpdate* moves, std::size_t n, const std::uint32_t* at, Aabb* boxes, KeyBox* keys,
             float* steps) {
  for (std::size_t m = 0; m < n; ++m) put(moves[m].box, boxes[at[m]], keys[at[m]], steps[at[m]]);
}

}  // namespace
}  // namespace touchstone::broad::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace touchstone::broad {

HWY_EXPORT(put_all);

void put_boxes(std::span<const BoxUpdate> moves, const std::uint32_t* at, Aabb* boxes, KeyBox* keys,
               float* steps) {
  HWY_DYNAMIC_DISPATCH(put_all)(moves.data(), moves.size(), at, boxes, keys, steps);
}

}  // namespace touchstone::broad
#endif
