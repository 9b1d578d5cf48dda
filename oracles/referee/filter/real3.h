// Vectors of long doubles, the referee's working arithmetic: unit roundoff at most 2^-64 (x87: 64 bits;
// ARM64: 113 bits, emulated), exponents wide enough that no product of a few doubles overflows or underflows.
// The first level searches with the same vectors in doubles, the last ones with exact numbers in them. All
// error bounds in this room are stated in `unit` or, where the arithmetic is a parameter, in `unit_of<T>`.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/math/pose.h"

namespace touchstone::referee {

using Real = long double;
static_assert(std::numeric_limits<Real>::digits >= 64 && std::numeric_limits<Real>::max_exponent >= 16384,
              "the referee's error bounds assume a long double of 64 bits and 15 bits of exponent");
inline constexpr Real unit = 0x1p-64L;  // at least half an ulp of 1

/// Half an ulp of 1. Every bound in this room is a multiple of the unit of the arithmetic it is about.
template <class T>
inline constexpr T unit_of = std::numeric_limits<T>::epsilon() / 2;
static_assert(unit_of<Real> <= unit && unit_of<double> == 0x1p-53);

/// Error bounds of short computations, as counts of roundings of one unit each, with some to spare.
/// value: a quotient, a norm, or a product or sum of a few numbers, relative to it or to its largest term.
/// difference: a vertex of a difference times a direction, relative to the sum of the extents.
/// dot: a dot product, relative to the product of the lengths; a placed point, relative to its distance.
/// projection: a dot product divided by a norm, or a weighted sum of points, relative to their distance.
/// chain: what is computed from placed points in several such steps, relative to their extent.
inline constexpr int value_roundings = 4, difference_roundings = 5, dot_roundings = 8,
                     projection_roundings = 16, chain_roundings = 64;
template <class T>
inline constexpr T value_rounding_of = value_roundings* unit_of<T>;
template <class T>
inline constexpr T difference_rounding_of = difference_roundings* unit_of<T>;
template <class T>
inline constexpr T dot_rounding_of = dot_roundings* unit_of<T>;
template <class T>
inline constexpr T projection_rounding_of = projection_roundings* unit_of<T>;
template <class T>
inline constexpr T chain_rounding_of = chain_roundings* unit_of<T>;
inline constexpr Real value_rounding = value_rounding_of<Real>, dot_rounding = dot_rounding_of<Real>,
                      projection_rounding = projection_rounding_of<Real>,
                      chain_rounding = chain_rounding_of<Real>;

/// The square of a length below this may have lost digits to underflow; nothing is divided by its root.
template <class T>
inline constexpr T least_square = std::numeric_limits<T>::min() * static_cast<T>(0x1p120);

template <class T>
struct Triple {
  T x = 0, y = 0, z = 0;
  const T& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};
using Real3 = Triple<Real>;
using Double3 = Triple<double>;

template <class T>
Triple<T> operator+(const Triple<T>& a, const Triple<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Triple<T> operator-(const Triple<T>& a, const Triple<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Triple<T> operator-(const Triple<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
Triple<T> operator*(std::type_identity_t<T> s, const Triple<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
T dot(const Triple<T>& a, const Triple<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T norm(const Triple<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
template <class T>
T largest(const Triple<T>& a) {
  using std::abs;
  return std::max<T>(abs(a.x), std::max<T>(abs(a.y), abs(a.z)));
}
inline Real3 to_real(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Real3 to_real(const Double3& v) { return {v.x, v.y, v.z}; }
inline Vec3 to_double(const Real3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline Double3 to_double3(const Real3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
/// Within a few units of a unit vector; zero stays zero.
template <class T>
Triple<T> normalized(const Triple<T>& a) {
  const T n = norm(a);
  return n > 0 ? (1 / n) * a : a;
}
/// A vector perpendicular to `a` (not zero), of length between |a|/2 and |a|.
template <class T>
Triple<T> perpendicular(const Triple<T>& a) {
  using std::abs;
  const T ax = abs(a.x), ay = abs(a.y), az = abs(a.z);
  if (ax <= ay && ax <= az) return {0, -a.z, a.y};
  if (ay <= az) return {-a.z, 0, a.x};
  return {-a.y, a.x, 0};
}

/// A near-unit vector perpendicular to the unit vector `u` within 4 units, along the perpendicular part of
/// `a`; when that part is rounding noise (which may well point along u), some perpendicular vector.
template <class T>
Triple<T> unit_across(const Triple<T>& a, const Triple<T>& u) {
  Triple<T> e = normalized(a - dot(a, u) * u);
  for (int i = 0; i < 2; ++i) e = normalized(e - dot(e, u) * u);
  using std::abs;
  return abs(dot(e, u)) <= value_rounding_of<T> && largest(e) > 0 ? e : normalized(perpendicular(u));
}

/// Normal of a triangle, counter-clockwise, from the two edges that meet at its widest angle: for two long
/// and nearly parallel edges the rounding of the product is large compared with its length and tilts it along
/// them; a short edge is exact up to its own rounding (Sterbenz).
template <class T>
Triple<T> triangle_normal(const Triple<T>& p, const Triple<T>& q, const Triple<T>& r) {
  const Triple<T> a = q - p, b = r - q, c = p - r;
  const T aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  return bb >= aa && bb >= cc ? cross(c, a) : cc >= aa ? cross(a, b) : cross(b, c);
}

/// Row-major.
template <class T>
struct Square {
  Triple<T> row[3];
};
using Matrix3 = Square<Real>;
template <class T>
Triple<T> operator*(const Square<T>& m, const Triple<T>& v) {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
template <class T>
Triple<T> transpose_times(const Square<T>& m, const Triple<T>& v) {
  return v.x * m.row[0] + v.y * m.row[1] + v.z * m.row[2];
}
template <class T>
Triple<T> column(const Square<T>& m, int j) {
  return {m.row[0][j], m.row[1][j], m.row[2][j]};
}
template <class T>
T largest(const Square<T>& m) {
  return std::max(largest(m.row[0]), std::max(largest(m.row[1]), largest(m.row[2])));
}
template <class T>
Square<T> operator*(const Square<T>& a, const Square<T>& b) {
  Square<T> r;
  for (int i = 0; i < 3; ++i) r.row[i] = transpose_times(b, a.row[i]);
  return r;
}

/// The double just at or below / above a long double.
inline double round_down(Real x) {
  const double d = static_cast<double>(x);
  return static_cast<Real>(d) > x ? std::nextafter(d, -std::numeric_limits<double>::infinity()) : d;
}
inline double round_up(Real x) { return -round_down(-x); }

/// Sign of det(a, b, c).
int determinant_sign(const Real3& a, const Real3& b, const Real3& c);
/// Sign of det(b - a, c - a, p - a): > 0 when p is in front of the triangle, seen from the side on which a,
/// b, c are counter-clockwise.
int orientation_sign(const Real3& a, const Real3& b, const Real3& c, const Real3& p);

}  // namespace touchstone::referee
