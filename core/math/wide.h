// The extended scalar in which the core computes what it reports in double, and rigid frames in any scalar.
// Every operation is within 2⁻⁶⁴, relative, so the roundings between a pose and a depth add up to about
// 1e-18·L, 1/10000 of the core's τ.
//
// Two implementations, chosen at build time (TOUCHSTONE_WIDE): the 80-bit long double of x87, with 64 bits
// and 15 of exponent, and DoubleDouble, with 102 bits and the exponents of double. Where the squares of
// lengths would leave the latter's range, callers scale by powers of two first (core/narrow/unit_scale.h).
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#include "core/math/axis_rotation.h"
#include "core/math/double_double.h"
#include "core/math/pose.h"

namespace touchstone {

#if LDBL_MANT_DIG == 64 && !defined(TOUCHSTONE_WIDE_DOUBLE_DOUBLE)
using Wide = long double;
#else
using Wide = DoubleDouble;
#endif
static_assert(std::numeric_limits<Wide>::digits >= 64,
              "the core's error bounds assume 64 bits of significand");

/// Whether Wide holds the square of every double.
inline constexpr bool wide_holds_squares =
    std::numeric_limits<Wide>::max_exponent > 2 * std::numeric_limits<double>::max_exponent;

// Unqualified calls find the functions of any scalar, also those of DoubleDouble.
using std::abs;
using std::cos;
using std::ldexp;
using std::sin;
using std::sqrt;

template <class R>
using V3 = Eigen::Matrix<R, 3, 1>;
template <class R>
using M3 = Eigen::Matrix<R, 3, 3>;
using WideVec = V3<Wide>;
using WideMat = M3<Wide>;

/// x_world = rotation·x_local + translation.
template <class R>
struct Frame {
  M3<R> rotation = M3<R>::Identity();
  V3<R> translation = V3<R>::Zero();
};
using WideFrame = Frame<Wide>;

/// A quaternion of the same rotation whose squares Wide holds.
inline Quat in_range_of_wide(const Quat& q) {
  if (wide_holds_squares) return q;
  const int e = -std::ilogb(std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)}));
  return {std::ldexp(q.x, e), std::ldexp(q.y, e), std::ldexp(q.z, e), std::ldexp(q.w, e)};
}

/// |v|, also where Wide does not hold the squares.
inline Wide wide_norm(const WideVec& v) {
  if constexpr (wide_holds_squares) {
    return v.norm();
  } else {
    const double most = v.cast<double>().cwiseAbs().maxCoeff();
    if (!(most > 0) || !std::isfinite(most)) return most;
    const int e = std::ilogb(most);
    return ldexp(WideVec(v.unaryExpr([&](const Wide& x) { return ldexp(x, -e); })).norm(), e);
  }
}

/// R(q) of any finite non-zero quaternion. Each entry is a quotient of sums of four products; its error is at
/// most 12 units of 2⁻⁶⁴.
inline WideMat wide_rotation(const Quat& any) {
  const Quat q = in_range_of_wide(any);
  const Wide x = q.x, y = q.y, z = q.z, w = q.w, n = x * x + y * y + z * z + w * w;
  WideMat r;
  r << (w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n,
      2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n,
      2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n;
  return r;
}

inline WideFrame wide_frame(const Pose& p) { return {wide_rotation(p.rotation), p.translation.cast<Wide>()}; }

/// Each column rotated by t·angular.
template <class Columns>
Columns turned(const Columns& x, const WideVec& angular, Wide t) {
  const Wide speed = wide_norm(angular);
  if (!(speed > 0) || t == 0) return x;
  return rotation_about<Wide>(angular / speed, speed * t) * x;
}

/// The frame at time t under truth.md's motion: rotation about the body's origin, world axes.
inline WideFrame wide_frame_at(const Pose& p, const Motion& m, Wide t) {
  return {turned(wide_rotation(p.rotation), m.angular.cast<Wide>(), t),
          p.translation.cast<Wide>() + t * m.linear.cast<Wide>()};
}

}  // namespace touchstone
