// Poses and motions as data. A quaternion (x, y, z, w) need not have unit length: any non-zero q denotes the
// rotation R(q) = (quadratic form in q) / |q|², whose entries are rational in q (truth.md §1). Right-handed,
// column vectors, x_world = R x_local + t, lengths in the scene's unit.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

struct Quat {
  double x = 0, y = 0, z = 0, w = 1;
  bool operator==(const Quat&) const = default;
};

struct Pose {
  Vec3 translation = Vec3::Zero();
  Quat rotation;
  bool operator==(const Pose& o) const { return translation == o.translation && rotation == o.rotation; }
};

/// Constant velocities over one step t in [0,1], world frame, rotation about the body's origin:
/// x(t) = x0 + linear·t, q(t) = exp(t·angular) ∘ q0. `angular` is in radians per step.
struct Motion {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
  bool operator==(const Motion& o) const { return linear == o.linear && angular == o.angular; }
};

/// A pose as a rotation matrix in rounded arithmetic, the form that most engines hold.
struct Transform {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();
  Vec3 operator*(const Vec3& x_local) const { return rotation * x_local + translation; }
  bool operator==(const Transform& o) const { return rotation == o.rotation && translation == o.translation; }
};

/// An exact affine placement: world = matrix·local + translation; each entry is a double that denotes itself.
/// This is what an engine holds after conversion. The matrix is a rotation only up to that engine's rounding.
struct Placement {
  Mat3 matrix = Mat3::Identity();
  Vec3 translation = Vec3::Zero();
  bool operator==(const Placement& o) const { return matrix == o.matrix && translation == o.translation; }
};

/// The unit quaternion nearest to q, in double arithmetic. Scales by a power of two first, so that no
/// component overflows or underflows. Precondition: q is finite and not zero.
inline Quat normalized(const Quat& q) {
  const double m = std::max(std::max(std::abs(q.x), std::abs(q.y)), std::max(std::abs(q.z), std::abs(q.w)));
  const int e = -std::ilogb(m);
  const double x = std::ldexp(q.x, e), y = std::ldexp(q.y, e), z = std::ldexp(q.z, e), w = std::ldexp(q.w, e);
  const double n = std::sqrt(x * x + y * y + z * z + w * w);
  return {x / n, y / n, z / n, w / n};
}

/// R(q) for any finite non-zero q. Exact for the identity and for axis permutations; entries within 4 ulp
/// otherwise.
inline Mat3 rotation_matrix(const Quat& q0) {
  const double m = std::max(std::max(std::abs(q0.x), std::abs(q0.y)), std::max(std::abs(q0.z), std::abs(q0.w)));
  const int e = -std::ilogb(m);
  const double x = std::ldexp(q0.x, e), y = std::ldexp(q0.y, e), z = std::ldexp(q0.z, e), w = std::ldexp(q0.w, e);
  const double n = x * x + y * y + z * z + w * w;
  Mat3 r;
  r << (w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n,
      2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n,
      2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n;
  return r;
}

inline Transform to_transform(const Pose& p) { return {rotation_matrix(p.rotation), p.translation}; }

inline Quat operator*(const Quat& a, const Quat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/// The pose at time t, in double arithmetic.
inline Pose pose_at(const Pose& p, const Motion& m, double t) {
  Pose r = p;
  r.translation += t * m.linear;
  const double angle = t * m.angular.norm();
  if (angle != 0) {
    const Vec3 axis = m.angular.normalized() * std::sin(angle / 2);
    r.rotation = Quat{axis.x(), axis.y(), axis.z(), std::cos(angle / 2)} * normalized(p.rotation);
  }
  return r;
}

}  // namespace touchstone
