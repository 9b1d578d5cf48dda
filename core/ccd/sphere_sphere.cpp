// |p + s·v| = r with p, v the relative position and velocity: a s² + 2 b s + c = 0, a = v·v, b = p·v, c = p·p
// − r². The first root is c / (−b + √(b² − a c)), free of cancellation where b < 0 < c; in long double, so
// that squares of coordinates keep the precision of the doubles.
#include "core/ccd/sphere_sphere.h"

#include <cmath>

#include "core/ccd/pose_in_motion.h"

namespace touchstone {
namespace {

using Real = long double;

// The root, or a negative number for "none in [0,1]".
Real first_root(const MovingShape& sa, const MovingShape& sb, Real radius) {
  Real a = 0, b = 0, dist_sq = 0;
  for (int i = 0; i < 3; ++i) {
    const Real p = static_cast<Real>(sb.pose.translation[i]) - sa.pose.translation[i];
    const Real v = static_cast<Real>(sb.motion.linear[i]) - sa.motion.linear[i];
    a += v * v, b += p * v, dist_sq += p * p;
  }
  const Real dist = std::sqrt(dist_sq);
  const Real c = (dist - radius) * (dist + radius);
  if (c <= 0) return 0;
  if (b >= 0) return -1;
  const Real disc = b * b - a * c;
  if (disc < 0) return -1;
  const Real t = c / (-b + std::sqrt(disc));
  return t <= 1 ? t : -1;
}

}  // namespace

TimeOfImpact sphere_sphere_impact(const MovingShape& a, const MovingShape& b) {
  const Real radius =
      static_cast<Real>(std::get<Sphere>(*a.shape).radius) + std::get<Sphere>(*b.shape).radius;
  const Real root = first_root(a, b, radius);
  TimeOfImpact out;
  if (root < 0) return out;
  out.hit = true;
  out.t = static_cast<double>(root);
  // Rounded down: never later than the contact.
  if (static_cast<Real>(out.t) > root) out.t = std::nextafter(out.t, 0.0);
  const DistanceAnswer d = distance({a.shape, pose_in_motion(a.pose, a.motion, out.t)},
                                    {b.shape, pose_in_motion(b.pose, b.motion, out.t)});
  out.outcome = d.outcome, out.gap = d.distance, out.normal = d.normal, out.witness = d.witness;
  out.steps = 1;
  return out;
}

}  // namespace touchstone
