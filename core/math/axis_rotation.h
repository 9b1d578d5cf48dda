// Rotation by an angle about an axis through the origin (Rodrigues 1840): with K x = axis × x,
// I + sin θ K + (1 − cos θ) K².
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace touchstone {

/// As a matrix. `axis`: unit; `angle`: radians.
template <class R>
Eigen::Matrix<R, 3, 3> rotation_about(const Eigen::Matrix<R, 3, 1>& axis, R angle) {
  using std::cos;
  using std::sin;
  const R s = sin(angle), c = cos(angle), k = 1 - c;
  const Eigen::Matrix<R, 3, 1>& u = axis;
  Eigen::Matrix<R, 3, 3> q;
  q << c + k * u[0] * u[0], k * u[0] * u[1] - s * u[2], k * u[0] * u[2] + s * u[1],  //
      k * u[0] * u[1] + s * u[2], c + k * u[1] * u[1], k * u[1] * u[2] - s * u[0],   //
      k * u[0] * u[2] - s * u[1], k * u[1] * u[2] + s * u[0], c + k * u[2] * u[2];
  return q;
}

/// Of one vector x: it changes by no more than a few roundings of the angle times |x|, however small the
/// angle, because 1 − cos θ is computed as 2 sin²(θ/2).
template <class R>
Eigen::Matrix<R, 3, 1> rotated(const Eigen::Matrix<R, 3, 1>& x, const Eigen::Matrix<R, 3, 1>& axis, R angle) {
  using std::sin;
  const R s = sin(angle), half = sin(angle / 2);
  const Eigen::Matrix<R, 3, 1> across = axis.cross(x);
  return x + s * across + 2 * half * half * axis.cross(across);
}

}  // namespace touchstone
