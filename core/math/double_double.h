// A scalar of 106 bits: the unevaluated sum of two doubles, for machines whose long double is no wider than
// double or is emulated.
//
// Relative error bounds, u = 2⁻⁵³, without overflow and underflow. Sources: [J] Joldes, Muller, Popescu 2017,
// "Tight and rigorous error bounds for basic building blocks of double-word arithmetic"; [M] Muller, Rideau
// 2022, "Formalization of double-word arithmetic, and comments on [J]"; [L] Lefèvre, Louvet, Muller, Picot,
// Rideau 2023, "Accurate calculation of Euclidean norms using double-word arithmetic".
//
//   x + y   3u² + 13u³   [J] algorithm 6, also where terms cancel; with a double, 2u² ([J] 4)
//   x · y   5u²          [J] algorithm 10, bound of [M]; with a double, 3u² ([J] 8)
//   x / y   15u² + 56u³  [J] algorithm 17; by a double, 3u² ([J] 15)
//   √x      25/8 u²      [L] algorithm 8
//
// The exponents are those of double. Results keep these bounds from 2⁻⁹⁶⁹ to 2¹⁰²³; below, they degrade to
// double's own underflow. Overflow gives ±infinity as in double.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <ostream>

#include "core/math/error_free.h"

namespace touchstone {

class DoubleDouble {
 public:
  constexpr DoubleDouble() = default;
  /// Implicit, as from double to long double. An integer passes through double.
  constexpr DoubleDouble(double x) : high_(x) {}
  /// Precondition: high is the rounding of high + low.
  constexpr DoubleDouble(double high, double low) : high_(high), low_(low) {}

  /// Rounds to the nearest double.
  constexpr explicit operator double() const { return high_; }
  constexpr double high() const { return high_; }
  constexpr double low() const { return low_; }

  constexpr DoubleDouble operator-() const { return {-high_, -low_}; }
  constexpr DoubleDouble operator+() const { return *this; }

  friend constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const Rounded s = two_sum(a.high_, b.high_), t = two_sum(a.low_, b.low_);
    const Rounded v = fast_two_sum(s.value, s.error + t.value);
    return normalized(v.value, t.error + v.error, s.value);
  }
  friend constexpr DoubleDouble operator+(const DoubleDouble& a, double b) {
    const Rounded s = two_sum(a.high_, b);
    return normalized(s.value, a.low_ + s.error, s.value);
  }
  friend constexpr DoubleDouble operator+(double a, const DoubleDouble& b) { return b + a; }
  friend constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend constexpr DoubleDouble operator-(const DoubleDouble& a, double b) { return a + -b; }
  friend constexpr DoubleDouble operator-(double a, const DoubleDouble& b) { return -b + a; }

  friend constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const Rounded p = two_product(a.high_, b.high_);
    return normalized(p.value, p.error + (a.high_ * b.low_ + a.low_ * b.high_), p.value);
  }
  friend constexpr DoubleDouble operator*(const DoubleDouble& a, double b) {
    const Rounded p = two_product(a.high_, b);
    return normalized(p.value, p.error + a.low_ * b, p.value);
  }
  friend constexpr DoubleDouble operator*(double a, const DoubleDouble& b) { return b * a; }

  friend constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double q = a.high_ / b.high_;
    const DoubleDouble p = b * q;
    const double rest = (a.high_ - p.high_) + (a.low_ - p.low_);
    return normalized(q, rest / b.high_, q);
  }
  friend constexpr DoubleDouble operator/(const DoubleDouble& a, double b) {
    const double q = a.high_ / b;
    const Rounded p = two_product(q, b);
    return normalized(q, (((a.high_ - p.value) - p.error) + a.low_) / b, q);
  }
  friend constexpr DoubleDouble operator/(double a, const DoubleDouble& b) { return DoubleDouble(a) / b; }

  template <class T>
  constexpr DoubleDouble& operator+=(const T& b) {
    return *this = *this + b;
  }
  template <class T>
  constexpr DoubleDouble& operator-=(const T& b) {
    return *this = *this - b;
  }
  template <class T>
  constexpr DoubleDouble& operator*=(const T& b) {
    return *this = *this * b;
  }
  template <class T>
  constexpr DoubleDouble& operator/=(const T& b) {
    return *this = *this / b;
  }

  friend constexpr bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high_ == b.high_ && a.low_ == b.low_;
  }
  friend constexpr bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high_ < b.high_ || (a.high_ == b.high_ && a.low_ < b.low_);
  }
  friend constexpr bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high_ < b.high_ || (a.high_ == b.high_ && a.low_ <= b.low_);
  }
  friend constexpr bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend constexpr bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }

 private:
  // high + low, |high| >= |low|. Where the transforms have no finite error, `rounded` is the result.
  static constexpr DoubleDouble normalized(double high, double low, double rounded) {
    const Rounded r = fast_two_sum(high, low);
    if (r.error - r.error != 0) return {rounded};
    return {r.value, r.error};
  }

  double high_ = 0, low_ = 0;
};

/// For messages: as a sum.
inline std::ostream& operator<<(std::ostream& out, const DoubleDouble& x) {
  return out << x.high() << (x.low() < 0 ? " - " : " + ") << std::abs(x.low());
}

constexpr DoubleDouble abs(const DoubleDouble& x) { return x < 0 ? -x : x; }
inline bool isfinite(const DoubleDouble& x) { return std::isfinite(x.high()); }
inline DoubleDouble ldexp(const DoubleDouble& x, int exponent) {
  return {std::ldexp(x.high(), exponent), std::ldexp(x.low(), exponent)};
}

inline DoubleDouble sqrt(const DoubleDouble& x) {
  const double root = std::sqrt(x.high());
  const Rounded square = two_product(root, root);
  const double rest = x.low() + ((x.high() - square.value) - square.error);
  const Rounded r = fast_two_sum(root, rest / (2 * root));
  if (r.error - r.error != 0) return {root};
  return {r.value, r.error};
}

struct SineCosine {
  DoubleDouble sine, cosine;
};

namespace detail {

/// 1/n!
constexpr DoubleDouble inverse_factorial(int n) {
  double product = 1;  // exact up to 22!
  for (int k = 2; k <= n; ++k) product *= k;
  return DoubleDouble(1) / product;
}

/// Σ (−z)ᵏ/(first + 2k)!, k = 0 .. 7, for 0 <= z <= (π/32)². The last four terms are below 2⁻⁴⁷ of the first,
/// so doubles are enough for them.
inline DoubleDouble alternating_series(int first, const DoubleDouble& z) {
  static constexpr auto from = [](int n) {
    std::array<DoubleDouble, 8> c;
    for (int k = 0; k < 8; ++k)
      c[static_cast<std::size_t>(k)] = (k % 2 ? -1 : 1) * inverse_factorial(n + 2 * k);
    return c;
  };
  static constexpr std::array<DoubleDouble, 8> even = from(2), odd = from(3);
  const auto& c = first == 2 ? even : odd;
  const double s = z.high();
  DoubleDouble sum = c[4].high() + s * (c[5].high() + s * (c[6].high() + s * c[7].high()));
  for (std::size_t k = 4; k-- > 0;) sum = sum * z + c[k];
  return sum;
}

/// sin(k·π/16) for k = 0 .. 8, rounded to nearest.
inline constexpr std::array<DoubleDouble, 9> sines = {{{0},
                                                       {0x1.8f8b83c69a60bp-3, -0x1.26d19b9ff8d82p-57},
                                                       {0x1.87de2a6aea963p-2, -0x1.72cedd3d5a610p-57},
                                                       {0x1.1c73b39ae68c8p-1, 0x1.b25dd267f6600p-55},
                                                       {0x1.6a09e667f3bcdp-1, -0x1.bdd3413b26456p-55},
                                                       {0x1.a9b66290ea1a3p-1, 0x1.9f630e8b6dac8p-60},
                                                       {0x1.d906bcf328d46p-1, 0x1.457e610231ac2p-56},
                                                       {0x1.f6297cff75cb0p-1, 0x1.562172a361fd3p-56},
                                                       {1}}};

/// x − k·π/16 for an integer k, with π/16 to 160 bits.
inline DoubleDouble without_sixteenths(const DoubleDouble& x, double k) {
  constexpr double a = 0x1.921fb54442d18p-3, b = 0x1.1a62633145c07p-57, c = -0x1.f1976b7ed8fbcp-113;
  const Rounded ka = two_product(k, a), kb = two_product(k, b);
  return ((x - DoubleDouble(ka.value, ka.error)) - DoubleDouble(kb.value, kb.error)) - k * c;
}

}  // namespace detail

/// Both within 2⁻¹⁰¹ + 2⁻¹⁵⁴·|x| of the exact ones (absolute). From |x| = 2¹⁰⁰ on, where the last bit of x is
/// worth 2⁻⁶ radians and more, the angle is taken as zero. Method: the angle is reduced to a multiple of π/16
/// and a rest of at most π/32, whose sine and cosine are Taylor series, and the addition theorem joins them
/// (Hida, Li, Bailey 2001, "Algorithms for quad-double precision floating point arithmetic", §3.4).
inline SineCosine sine_and_cosine(DoubleDouble x) {
  constexpr double sixteenths = 0x1.45f306dc9c883p+2;  // in a radian
  constexpr double meaningless = 0x1p100, near = 0x1p30;
  if (!(std::abs(x.high()) < meaningless)) return {x - x, 1 + (x - x)};
  while (std::abs(x.high()) > near)
    x = detail::without_sixteenths(x, 32 * std::nearbyint(x.high() * (sixteenths / 32)));
  const double k = std::nearbyint(x.high() * sixteenths);
  const DoubleDouble r = detail::without_sixteenths(x, k), z = r * r;
  const DoubleDouble sine = r - r * (z * detail::alternating_series(3, z));
  const DoubleDouble cosine = 1 - z * detail::alternating_series(2, z);
  const auto index = static_cast<std::int64_t>(k) & 31;
  const auto j = static_cast<std::size_t>(index & 7);
  const DoubleDouble &sine_k = detail::sines[j], &cosine_k = detail::sines[8 - j];
  const DoubleDouble s = sine_k * cosine + cosine_k * sine, c = cosine_k * cosine - sine_k * sine;
  switch (index >> 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}
inline DoubleDouble sin(const DoubleDouble& x) { return sine_and_cosine(x).sine; }
inline DoubleDouble cos(const DoubleDouble& x) { return sine_and_cosine(x).cosine; }

}  // namespace touchstone

// `digits` is such that epsilon()/2 = 16u² bounds the relative error of each operation above, which is what
// code that reads it relies on. min(): the least magnitude whose low part is a normal double.
template <>
class std::numeric_limits<touchstone::DoubleDouble> {
  using T = touchstone::DoubleDouble;

 public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false,
                        has_infinity = true, has_quiet_NaN = true, has_signaling_NaN = false,
                        is_iec559 = false, is_bounded = true, is_modulo = false, traps = false,
                        tinyness_before = false;
  static constexpr std::float_round_style round_style = std::round_indeterminate;
  static constexpr int radix = 2, digits = 102, digits10 = 30, max_digits10 = 33;
  static constexpr int min_exponent = -968, max_exponent = 1024, min_exponent10 = -291, max_exponent10 = 308;
  static constexpr T min() { return 0x1p-969; }
  static constexpr T max() { return {0x1.fffffffffffffp+1023, 0x1.fffffffffffffp+969}; }
  static constexpr T lowest() { return -max(); }
  static constexpr T epsilon() { return 0x1p-101; }
  static constexpr T round_error() { return 1; }
  static constexpr T infinity() { return std::numeric_limits<double>::infinity(); }
  static constexpr T quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
  static constexpr T denorm_min() { return std::numeric_limits<double>::denorm_min(); }
};

template <>
inline constexpr touchstone::DoubleDouble std::numbers::pi_v<touchstone::DoubleDouble> = {
    0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

template <>
struct Eigen::NumTraits<touchstone::DoubleDouble> : Eigen::GenericNumTraits<touchstone::DoubleDouble> {
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 20,
    MulCost = 25
  };
  static touchstone::DoubleDouble dummy_precision() { return 0x1p-90; }
};
