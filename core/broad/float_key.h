// Boxes as integers. The structures compare 32-bit keys; doubles are compared only when keys cannot decide.
//
// key(f) numbers the finite floats and the two infinities in order: the bits of |f| with the sign of f, so
// that −0 and +0 share key 0 and neighbours differ by 1. A lower end d gets the key of the largest float <=
// d, an upper end the key of the smallest float >= d. With value(k) the float of key k:
//   value(k_lo) <= d_lo < value(k_lo + 1),   value(k_hi − 1) < d_hi <= value(k_hi).
//  * d_lo <= d_hi implies k_lo <= k_hi, because both maps are monotone and value(k_lo) <= value(k_hi): no pair
//    of overlapping double boxes is lost.
//  * k_lo + 2 <= k_hi implies d_lo < value(k_lo + 1) <= value(k_hi − 1) < d_hi: the doubles certainly overlap.
// In between (touching, or a gap or overlap below one float's spacing) the double boxes are compared, so that
// the reported pairs are exactly those of the double boxes. With integers, no mode of the floating-point unit
// (flush to zero) can lose a pair inside a structure.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "core/math/aabb.h"

namespace touchstone::broad {

inline std::int32_t key_of(float f) {
  const auto bits = std::bit_cast<std::int32_t>(f);
  return bits < 0 ? -(bits & 0x7fffffff) : bits;
}

inline float value_of(std::int32_t key) {
  const std::int32_t negative = key >> 31, size = (key ^ negative) - negative;
  return std::bit_cast<float>(size | (negative & std::numeric_limits<std::int32_t>::min()));
}

/// Key of the largest float <= d.
inline std::int32_t key_below(double d) {
  const float f = static_cast<float>(d);
  return key_of(f) - (static_cast<double>(f) > d ? 1 : 0);
}

/// Key of the smallest float >= d.
inline std::int32_t key_above(double d) {
  const float f = static_cast<float>(d);
  return key_of(f) + (static_cast<double>(f) < d ? 1 : 0);
}

/// Lengths from here on are treated as unbounded: their difference from any key would lose meaning.
inline constexpr double longest_finite = 0x1p120;
/// Covers the rounding of a computed length; see earliest_start.
inline constexpr double length_slack = 0x1p-20;

/// A lower bound on keys: no box that reaches `lo` and whose length value(hi) − value(lo) is <= longest
/// (computed in float or double) begins below it. The computed length may be less than the exact one by 2⁻²⁴
/// of it: 2⁻²⁰ covers that and, for |lo| up to 2³⁰ lengths, the rounding of the difference here; beyond that,
/// subtracting one key is enough.
inline std::int32_t earliest_start(std::int32_t lo, double longest) {
  if (!(longest < longest_finite)) return -0x7ffffff0;
  return key_below(value_of(lo) - longest * (1 + length_slack)) - 1;
}

/// Greater than every key of a float by more than the margin of 2.
inline constexpr std::int32_t no_key = 0x7ffffff0;

/// One box. The default overlaps nothing, not even itself. 32 bytes, so that it takes one load.
struct alignas(32) KeyBox {
  std::int32_t lo[4] = {no_key, no_key, no_key, 0};
  std::int32_t hi[4] = {-no_key, -no_key, -no_key, 0};
};

inline KeyBox key_box(const Aabb& b) {
  return {{key_below(b.lo.x()), key_below(b.lo.y()), key_below(b.lo.z()), 0},
          {key_above(b.hi.x()), key_above(b.hi.y()), key_above(b.hi.z()), 0}};
}

}  // namespace touchstone::broad
