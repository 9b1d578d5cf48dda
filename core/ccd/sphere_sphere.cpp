#include "core/ccd/sphere_sphere.h"

#include <cmath>

#include "core/tolerance.h"

namespace touchstone::ccd {
namespace {

// The root of a t² + 2 b t + c with c > 0, b < 0 that comes first, written without cancellation. The
// discriminant is a (R² − d²) with d the closest approach, so that a graze loses no digits to b² − a c.
std::optional<Wide> first_root(const WideVec& p, const WideVec& v, Wide radii) {
  const Wide a = v.squaredNorm(), b = p.dot(v), dist = p.norm();
  if (!(b < 0)) return std::nullopt;
  const Wide d = p.cross(v).norm() / std::sqrt(a);
  if (d > radii) return std::nullopt;
  return (dist - radii) * (dist + radii) / (-b + std::sqrt(a * (radii - d) * (radii + d)));
}

}  // namespace

ImpactAnswer sphere_sphere(const MovingCore& a, const MovingCore& b) {
  const WideVec p = b.start.frame.translation - a.start.frame.translation, v = b.linear - a.linear;
  const Wide radii = a.start.radius + b.start.radius;
  const auto gap_at = [&](Wide t) { return (p + t * v).norm() - radii; };
  ImpactAnswer r;
  r.separation = static_cast<double>(gap_at(0));
  if (gap_at(0) <= tolerance::narrow_contact_factor * (p.norm() + radii)) return r.toi = 0, r;
  const auto root = first_root(p, v, radii);
  if (!root || *root > 1) {
    r.clear_until = 1, r.separation = static_cast<double>(gap_at(1));
    return r;
  }
  double t = static_cast<double>(*root);
  if (static_cast<Wide>(t) > *root) t = std::nextafter(t, 0.0);
  const double next = std::nextafter(t, 1.0);
  if (std::abs(gap_at(next)) < std::abs(gap_at(t)) &&
      gap_at(t) > tolerance::impact_gap_factor * (p.norm() + radii))
    t = next;
  r.toi = r.clear_until = t, r.separation = static_cast<double>(gap_at(t));
  return r;
}

}  // namespace touchstone::ccd
