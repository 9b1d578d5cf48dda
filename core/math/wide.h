// The extended scalar in which the core computes what it reports in double, and rigid frames in any scalar.
// Every operation is within 2⁻⁶⁴, relative, so the roundings between a pose and a depth add up to about
// 1e-18·L, 1/10000 of the core's τ.
//
// Two implementations, chosen at build time (TOUCHSTONE_WIDE): the 80-bit long double of x87, with 64 bits
// and 15 of exponent, and DoubleDouble, with 102 bits and the exponents of double. Where the squares of
// lengths would leave the latter's range, callers scale by powers of two first (core/narrow/unit_scale.h).
#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

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
Quat in_range_of_wide(const Quat& q);

/// |v|, also where Wide does not hold the squares.
Wide wide_norm(const WideVec& v);

/// R(q) of any finite non-zero quaternion. Each entry is a quotient of sums of four products; its error is at
/// most 12 units of 2⁻⁶⁴.
WideMat wide_rotation(const Quat& q);

WideFrame wide_frame(const Pose& p);

/// Each column rotated by t·angular.
WideVec turned(const WideVec& x, const WideVec& angular, Wide t);
WideMat turned(const WideMat& columns, const WideVec& angular, Wide t);

/// The frame at time t under truth.md's motion: rotation about the body's origin, world axes.
WideFrame wide_frame_at(const Pose& p, const Motion& m, Wide t);

}  // namespace touchstone
