// Exact numbers: GMP integers and rationals behind Boost.Multiprecision, and the exact value of a double.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <boost/multiprecision/gmp.hpp>
#include <string>

#include "core/math/pose.h"
#include "oracles/referee/filter/real3.h"

namespace touchstone::referee {

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

using Integer3 = Triple<Integer>;
using Rational3 = Triple<Rational>;

template <class T>
bool is_zero(const Triple<T>& a) {
  return a.x == 0 && a.y == 0 && a.z == 0;
}

/// x = mantissa·2^exponent, the mantissa odd. Zero has mantissa 0 and exponent 0.
struct Parts {
  long long mantissa = 0;
  int exponent = 0;
};
Parts parts_of(double x);

Rational exact(double x);
inline Rational3 exact(const Vec3& v) { return {exact(v.x()), exact(v.y()), exact(v.z())}; }
/// A number of more bits than a double is the sum of a few doubles, each the rounding of the remainder.
template <class T>
Rational exact_of(T x) {
  Rational sum = 0;
  for (auto part = static_cast<double>(x); part != 0; part = static_cast<double>(x)) {
    sum += exact(part);
    x -= T(part);
  }
  return sum;
}
template <class T>
Rational3 exact_of(const Triple<T>& v) {
  return {exact_of(v.x), exact_of(v.y), exact_of(v.z)};
}
Integer shifted(Integer x, int bits);  // x·2^bits, bits >= 0

/// The fraction with the least denominator in [lo, hi], by the continued fractions of both ends.
Rational simplest_between(const Rational& lo, const Rational& hi);

/// "n/d" in lowest terms, "n" when d = 1; and back. Throws InputError on anything else.
std::string text_of(const Rational& x);
Rational rational_from_text(const std::string& s);

// 512-bit integers on the stack, for numbers known beforehand to fit. What is decided in them counts as the
// filter's level 1.

using Short = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 512, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

}  // namespace touchstone::referee
