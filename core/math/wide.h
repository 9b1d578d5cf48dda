// The extended scalar in which the core computes what it reports in double, and rigid frames in any scalar.
// With 64 bits of significand (x87) the roundings between a pose and a depth add up to about 1e-18·L, 1/10000
// of the core's τ.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/axis_rotation.h"
#include "core/math/pose.h"

namespace touchstone {

using Wide = long double;
static_assert(std::numeric_limits<Wide>::digits >= 64,
              "the core's error bounds assume a long double of at least 64 bits of significand");

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

/// R(q) of any finite non-zero quaternion. The exponent range of Wide holds the square of every double, so
/// no scaling is needed. Each entry is a quotient of sums of four products; its error is at most 12 units of
/// 2⁻⁶⁴.
inline WideMat wide_rotation(const Quat& q) {
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
  const Wide speed = angular.norm();
  if (!(speed > 0) || t == 0) return x;
  return rotation_about<Wide>(angular / speed, speed * t) * x;
}

/// The frame at time t under truth.md's motion: rotation about the body's origin, world axes.
inline WideFrame wide_frame_at(const Pose& p, const Motion& m, Wide t) {
  return {turned(wide_rotation(p.rotation), m.angular.cast<Wide>(), t),
          p.translation.cast<Wide>() + t * m.linear.cast<Wide>()};
}

}  // namespace touchstone
