#include "core/world/fidelity.h"

#include <cmath>

namespace touchstone {

BoundingBall bounding_ball(const Shape& shape) {
  const auto* hull = std::get_if<Hull>(&shape);
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  if (!hull && !mesh) return {Vec3::Zero(), bounding_radius(shape)};
  const std::vector<Vec3>& points = hull ? hull->vertices : mesh->vertices;
  Aabb box;
  for (const Vec3& p : points) box.extend(p);
  BoundingBall ball{(box.lo + box.hi) / 2, 0};
  for (const Vec3& p : points) ball.radius = std::max(ball.radius, (p - ball.middle).norm());
  ball.radius += 0x1p-48 * (ball.radius + ball.middle.lpNorm<1>());
  return ball;
}

double float_rounding(const Pose& pose, double reach) {
  constexpr double u = 0x1p-24;
  return u * (pose.translation.lpNorm<1>() + 8 * reach);
}

ContactAnswer contact_by(const PairMethod& method, double error, double shapes_error, const PlacedShape& a,
                         double reach_a, const PlacedShape& b, double reach_b, PairMemory* memory,
                         bool* by_float) {
  if (by_float) *by_float = false;
  if (method.arithmetic == Arithmetic::float64) return contact(a, b, Arithmetic::float64, memory);
  // About A's translation, so that what float loses does not grow with the distance from the world's origin.
  const Vec3 origin = a.pose.translation;
  PlacedShape x = a, y = b;
  x.pose.translation.setZero();
  y.pose.translation -= origin;
  ContactAnswer r = contact(x, y, Arithmetic::float32, memory);
  const double rounding =
      float_rounding(x.pose, reach_a) + float_rounding(y.pose, reach_b) + 0x1p-52 * origin.lpNorm<1>();
  // A verdict `apart` is certain, of the bodies as rounded, and may come without a value.
  const bool no_value = !r.overlap && !std::isfinite(r.error_bound);
  const double bound = (no_value ? 0 : std::max(r.error_bound, r.regret_bound)) + rounding;
  // A NaN is no proof.
  if (r.outcome != Outcome::answered || !(bound + shapes_error <= Fidelity::answer_share * error))
    return contact(a, b, Arithmetic::float64, memory);
  if (by_float) *by_float = true;
  Manifold at_home;
  for (const ContactPoint& p : r.manifold) at_home.push_back({p.position + origin, p.depth, p.feature});
  r.manifold = at_home;
  r.error_bound += rounding, r.regret_bound += rounding;
  return r;
}

}  // namespace touchstone
