#include "core/ccd/pose_in_motion.h"

namespace touchstone {

Pose pose_in_motion(const Pose& start, const Motion& motion, double t) {
  using Real = long double;
  Pose p = start;
  for (int i = 0; i < 3; ++i)
    p.translation[i] = static_cast<double>(static_cast<Real>(start.translation[i]) +
                                           static_cast<Real>(t) * static_cast<Real>(motion.linear[i]));
  if (motion.angular.isZero(0) || t == 0) return p;
  const Real wx = motion.angular.x(), wy = motion.angular.y(), wz = motion.angular.z();
  const Real w = std::hypot(wx, wy, wz);
  const Real half = static_cast<Real>(t) * w / 2;
  const Real s = std::sin(half) / w, c = std::cos(half);
  const Real x = wx * s, y = wy * s, z = wz * s;
  // exp(tω) ∘ q0, unit·q0: the length of q0 is kept, and any length is legitimate.
  const Quat& q = start.rotation;
  const double m = std::max(std::max(std::abs(q.x), std::abs(q.y)), std::max(std::abs(q.z), std::abs(q.w)));
  const int e = -std::ilogb(m);
  const Real qx = std::ldexp(static_cast<Real>(q.x), e), qy = std::ldexp(static_cast<Real>(q.y), e),
             qz = std::ldexp(static_cast<Real>(q.z), e), qw = std::ldexp(static_cast<Real>(q.w), e);
  p.rotation = {static_cast<double>(c * qx + x * qw + y * qz - z * qy),
                static_cast<double>(c * qy - x * qz + y * qw + z * qx),
                static_cast<double>(c * qz + x * qy - y * qx + z * qw),
                static_cast<double>(c * qw - x * qx - y * qy - z * qz)};
  return p;
}

}  // namespace touchstone
