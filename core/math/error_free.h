// Error-free transforms of doubles: a rounded result and its exact error, in round to nearest. Sources:
// Knuth, TAOCP 2, §4.2.2 (sum); Dekker 1971, "A floating-point technique for extending the available
// precision" (ordered sum, splitting, product).
#pragma once

#include <cmath>
#include <type_traits>

namespace touchstone {

/// value + error is the exact result, and value is its rounding.
struct Rounded {
  double value, error;
};

/// Exact unless the sum overflows; then the error is NaN.
constexpr Rounded two_sum(double a, double b) {
  const double s = a + b, bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

/// The same for |a| >= |b| or a == 0.
constexpr Rounded fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

namespace detail {

struct Halves {
  double high, low;  // of 26 bits each; the low half has a sign of its own
};

/// 2^27 + 1, which splits 53 bits in two halves (Dekker 1971).
inline constexpr double splitter = 0x1.0000002p+27;

constexpr Halves split(double a) {
  const double c = splitter * a, high = c - (c - a);
  return {high, a - high};
}

constexpr double product_error(double a, double b, double p) {
  const Halves x = split(a), y = split(b);
  return ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low;
}

}  // namespace detail

/// Exact unless the product overflows (the error is then not finite) or is below 2⁻⁹⁶⁹ in magnitude, where
/// the error may underflow by 2⁻¹⁰⁷⁴.
constexpr Rounded two_product(double a, double b) {
  const double p = a * b;
#ifdef __FP_FAST_FMA
  if (!std::is_constant_evaluated()) return {p, std::fma(a, b, -p)};
#endif
  // Splitting multiplies by 2²⁷, which may overflow.
  constexpr double large = 0x1p990, down = 0x1p-60, up = 0x1p60;
  if (a > large || a < -large) return {p, up * detail::product_error(down * a, b, down * p)};
  if (b > large || b < -large) return {p, up * detail::product_error(a, down * b, down * p)};
  return {p, detail::product_error(a, b, p)};
}

}  // namespace touchstone
