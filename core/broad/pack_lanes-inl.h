// Packs the lanes of a mask to the front. Included once for each target (Highway's foreach_target).
//
// Replaces hn::Compress, which in Highway 1.0.3 with g++ 12 copies its table of 1 KB to the stack at each
// call on AVX2: 70 % of the time of a sweep (2026-11-21, Zen 3).
#if defined(TOUCHSTONE_CORE_BROAD_PACK_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TOUCHSTONE_CORE_BROAD_PACK_LANES_INL_H
#undef TOUCHSTONE_CORE_BROAD_PACK_LANES_INL_H
#else
#define TOUCHSTONE_CORE_BROAD_PACK_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace touchstone::broad::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Lanes 0 … CountTrue(m) − 1 are those of v where m is set, in order; the others are unspecified.
#if HWY_TARGET == HWY_AVX2
struct PackTable {
  alignas(32) std::int32_t lane[256][8];
};
constexpr PackTable make_pack_table() {
  PackTable t{};
  for (int mask = 0; mask < 256; ++mask)
    for (int bit = 0, n = 0; bit < 8; ++bit)
      if ((mask >> bit & 1) != 0) t.lane[mask][n++] = bit;
  return t;
}
inline constexpr PackTable pack_table = make_pack_table();

class Packer {
 public:
  explicit HWY_INLINE Packer(hn::Mask<hn::ScalableTag<std::int32_t>> m) {
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, m, bits);
    order_ = hn::Load(d, pack_table.lane[bits[0]]);
    count_ = static_cast<std::size_t>(__builtin_popcount(bits[0]));
  }
  HWY_INLINE hn::Vec<hn::ScalableTag<std::int32_t>> operator()(
      hn::Vec<hn::ScalableTag<std::int32_t>> v) const {
    return hn::TableLookupLanes(v, hn::IndicesFromVec(d, order_));
  }
  HWY_INLINE std::size_t count() const { return count_; }

 private:
  static constexpr hn::ScalableTag<std::int32_t> d{};
  hn::Vec<hn::ScalableTag<std::int32_t>> order_;
  std::size_t count_;
};
#else
class Packer {
 public:
  explicit HWY_INLINE Packer(hn::Mask<hn::ScalableTag<std::int32_t>> m)
      : mask_(m), count_(hn::CountTrue(hn::ScalableTag<std::int32_t>(), m)) {}
  HWY_INLINE hn::Vec<hn::ScalableTag<std::int32_t>> operator()(
      hn::Vec<hn::ScalableTag<std::int32_t>> v) const {
    return hn::Compress(v, mask_);
  }
  HWY_INLINE std::size_t count() const { return count_; }

 private:
  hn::Mask<hn::ScalableTag<std::int32_t>> mask_;
  std::size_t count_;
};
#endif

}  // namespace touchstone::broad::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
