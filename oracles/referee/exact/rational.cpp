#include "oracles/referee/exact/rational.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <string_view>

#include "core/base/input_error.h"
#include "oracles/referee/filter/real3.h"

namespace touchstone::referee {
namespace {

// A significand is read in pieces of 32 bits: two on x87, four where long double has 113 bits.
constexpr int piece = 32, pieces = (std::numeric_limits<Real>::digits + piece - 1) / piece;

// The three coordinates as integers in units of 2^exponent.
Integer3 on_grid(const Real3& v, int exponent) {
  const auto one = [&](Real x) -> Integer {
    if (x == 0) return 0;
    int e = 0;
    Real rest = std::frexp(x, &e);
    Integer all = 0;
    for (int i = 0; i < pieces; ++i) {
      rest = std::ldexp(rest, piece);
      const auto top = static_cast<long long>(rest);
      all = (all << piece) + top;
      rest -= static_cast<Real>(top);
    }
    return shifted(all, e - pieces * piece - exponent);
  };
  return {one(v.x), one(v.y), one(v.z)};
}

int least_exponent(const Real3& v) {
  int least = 0;
  bool any = false;
  for (int i = 0; i < 3; ++i) {
    if (v[i] == 0) continue;
    int e = 0;
    std::frexp(v[i], &e);
    least = any ? std::min(least, e) : e;
    any = true;
  }
  return least - pieces * piece;
}

Integer floor_of(const Rational& x) {
  const Integer n = numerator(x), d = denominator(x);
  const Integer q = n / d;  // towards zero
  return q * d > n ? Integer(q - 1) : q;
}

}  // namespace

Parts parts_of(double x) {
  if (x == 0) return {};
  int e = 0;
  const auto m = static_cast<long long>(std::ldexp(std::frexp(x, &e), 53));
  const int zeros = std::countr_zero(static_cast<unsigned long long>(m));
  return {m >> zeros, e - 53 + zeros};
}

Integer shifted(Integer x, int bits) {
  x <<= static_cast<unsigned>(bits);
  return x;
}

Rational exact(double x) {
  const Parts p = parts_of(x);
  if (p.exponent >= 0) return Rational(shifted(Integer(p.mantissa), p.exponent));
  return Rational(Integer(p.mantissa), shifted(Integer(1), -p.exponent));
}

Rational simplest_between(const Rational& lo, const Rational& hi) {
  const Integer whole = floor_of(lo);
  if (Rational(whole) == lo) return lo;
  if (Rational(whole + 1) <= hi) return Rational(whole + 1);
  const Rational w(whole);
  return w + Rational(1) / simplest_between(Rational(1) / (hi - w), Rational(1) / (lo - w));
}

std::string text_of(const Rational& x) { return x.str(); }

Rational rational_from_text(const std::string& s) {
  const auto slash = std::min(s.find('/'), s.size());
  const std::string n = s.substr(0, slash), d = slash < s.size() ? s.substr(slash + 1) : "1";
  const auto is_whole = [](std::string_view t) {
    return !t.empty() && (t.size() == 1 || t[0] != '0') &&
           t.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (!is_whole(std::string_view(n).substr(n.starts_with('-') ? 1 : 0)) || !is_whole(d) || d == "0")
    throw InputError("", "is not a rational number \"n/d\" (" + s + ")");
  return Rational(Integer(n), Integer(d));
}

// Nine multiplications form six terms of three factors, each of size <= |a|∞|b|∞|c|∞ and within 5 units of
// it: 30 units. Differences as factors add one unit of relative error each: 48.
constexpr Real determinant_rounding = 64 * unit, orientation_rounding = 96 * unit;

int determinant_sign(const Real3& a, const Real3& b, const Real3& c) {
  const Real det = dot(cross(a, b), c);
  if (std::fabs(det) > determinant_rounding * largest(a) * largest(b) * largest(c)) return det > 0 ? 1 : -1;
  const Integer3 x = on_grid(a, least_exponent(a)), y = on_grid(b, least_exponent(b)),
                 z = on_grid(c, least_exponent(c));
  return dot(cross(x, y), z).sign();
}

int orientation_sign(const Real3& a, const Real3& b, const Real3& c, const Real3& p) {
  const Real3 u = b - a, v = c - a, w = p - a;
  const Real det = dot(cross(u, v), w);
  if (std::fabs(det) > orientation_rounding * largest(u) * largest(v) * largest(w)) return det > 0 ? 1 : -1;
  const int e = std::min(std::min(least_exponent(a), least_exponent(b)),
                         std::min(least_exponent(c), least_exponent(p)));
  const Integer3 o = on_grid(a, e);
  return dot(cross(on_grid(b, e) - o, on_grid(c, e) - o), on_grid(p, e) - o).sign();
}

}  // namespace touchstone::referee
