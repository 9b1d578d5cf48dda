// Vectors of 80-bit long doubles, the working arithmetic of the referee's filter: unit roundoff 2^-64,
// exponents wide enough that no product of a few doubles overflows or underflows. All error bounds of this
// room are stated in `unit`.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/pose.h"

namespace touchstone::referee {

using Real = long double;
static_assert(std::numeric_limits<Real>::digits == 64,
              "the referee's error bounds assume x87 extended precision");
inline constexpr Real unit = 0x1p-64L;

struct Real3 {
  Real x = 0, y = 0, z = 0;
  Real operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

inline Real3 operator+(const Real3& a, const Real3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Real3 operator-(const Real3& a, const Real3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Real3 operator-(const Real3& a) { return {-a.x, -a.y, -a.z}; }
inline Real3 operator*(Real s, const Real3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Real dot(const Real3& a, const Real3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Real3 cross(const Real3& a, const Real3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real norm(const Real3& a) { return std::sqrt(dot(a, a)); }
inline Real largest(const Real3& a) {
  return std::fmax(std::fabs(a.x), std::fmax(std::fabs(a.y), std::fabs(a.z)));
}
inline Real3 to_real(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Vec3 to_double(const Real3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
/// Within a few units of a unit vector; zero stays zero.
inline Real3 normalized(const Real3& a) {
  const Real n = norm(a);
  return n > 0 ? (1 / n) * a : a;
}
/// A vector at a right angle to `a` (not zero), of length between |a|/2 and |a|.
inline Real3 perpendicular(const Real3& a) {
  const Real ax = std::fabs(a.x), ay = std::fabs(a.y), az = std::fabs(a.z);
  if (ax <= ay && ax <= az) return {0, -a.z, a.y};
  if (ay <= az) return {-a.z, 0, a.x};
  return {-a.y, a.x, 0};
}

/// A near-unit vector at a right angle to the unit vector `u` within 4 units, along the part of `a` that is
/// at a right angle to u; when that part is rounding noise (which may well point along u), still one at a
/// right angle.
inline Real3 unit_across(const Real3& a, const Real3& u) {
  Real3 e = normalized(a - dot(a, u) * u);
  for (int i = 0; i < 2; ++i) e = normalized(e - dot(e, u) * u);
  return std::fabs(dot(e, u)) <= 4 * unit && largest(e) > 0 ? e : normalized(perpendicular(u));
}

/// Row-major.
struct Matrix3 {
  Real3 row[3];
};
inline Real3 operator*(const Matrix3& m, const Real3& v) {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
inline Real3 transpose_times(const Matrix3& m, const Real3& v) {
  return v.x * m.row[0] + v.y * m.row[1] + v.z * m.row[2];
}
inline Real3 column(const Matrix3& m, int j) { return {m.row[0][j], m.row[1][j], m.row[2][j]}; }
inline Real largest(const Matrix3& m) {
  return std::fmax(largest(m.row[0]), std::fmax(largest(m.row[1]), largest(m.row[2])));
}
inline Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 r;
  for (int i = 0; i < 3; ++i) r.row[i] = transpose_times(b, a.row[i]);
  return r;
}

/// The double just at or below / above a long double.
inline double round_down(Real x) {
  const double d = static_cast<double>(x);
  return static_cast<Real>(d) > x ? std::nextafter(d, -std::numeric_limits<double>::infinity()) : d;
}
inline double round_up(Real x) { return -round_down(-x); }

}  // namespace touchstone::referee
