// Rigid transforms in double arithmetic, for readers of files: composition, and rotations as files write
// them.
#pragma once

#include <cmath>

#include "core/math/pose.h"

namespace touchstone {

/// outer ∘ inner. Exact when `inner` is the identity or a translation of an unrotated `outer`.
inline Pose compose(const Pose& outer, const Pose& inner) {
  Pose r;
  r.translation = outer.translation;
  if (!inner.translation.isZero(0)) r.translation += rotation_matrix(outer.rotation) * inner.translation;
  r.rotation = inner.rotation == Quat{} ? outer.rotation : outer.rotation * inner.rotation;
  return r;
}

/// Precondition: the rotation has unit length within rounding.
inline Pose inverse(const Pose& p) {
  Pose r;
  r.rotation = {-p.rotation.x, -p.rotation.y, -p.rotation.z, p.rotation.w};
  r.translation = -(rotation_matrix(r.rotation) * p.translation);
  return r;
}

/// By `angle` radians about `axis`, which has unit length. An angle of 0 gives the identity exactly.
inline Quat about(const Vec3& axis, double angle) {
  if (angle == 0) return {};
  const Vec3 v = axis * std::sin(angle / 2);
  return {v.x(), v.y(), v.z(), std::cos(angle / 2)};
}

/// Rz(yaw) Ry(pitch) Rx(roll): about fixed axes x, y, z in this order, as URDF and SDFormat define it.
inline Quat roll_pitch_yaw(const Vec3& rpy) {
  return about(Vec3::UnitZ(), rpy.z()) * (about(Vec3::UnitY(), rpy.y()) * about(Vec3::UnitX(), rpy.x()));
}

/// The shortest rotation that takes the z axis to the direction of d; half a turn about x for -z.
/// Precondition: d is not zero.
inline Quat from_z_to(const Vec3& d) {
  const Vec3 n = d.stableNormalized();
  if (n.x() == 0 && n.y() == 0) return n.z() > 0 ? Quat{} : Quat{1, 0, 0, 0};
  return about(Vec3(-n.y(), n.x(), 0).normalized(), std::atan2(std::hypot(n.x(), n.y()), n.z()));
}

}  // namespace touchstone
