#include "core/narrow/gradient.h"

#include <cmath>

#include "core/narrow/wide_answer.h"
#include "core/tolerance.h"

namespace touchstone {
namespace {

bool is_mesh(const PlacedShape& p) { return touchstone::is_mesh(*p.shape); }

}  // namespace

std::optional<DistanceGradient> gradient(const DistanceAnswer& answer, const Vec3& about) {
  constexpr double same =
      1e-6;  // of the distance: the points' direction is known to the root of their accuracy
  const Vec3 way = answer.witness[1] - answer.witness[0];
  if ((way - answer.distance * answer.normal).norm() > same * std::abs(answer.distance) + answer.error_bound)
    return std::nullopt;
  return DistanceGradient{answer.normal, (answer.witness[1] - about).cross(answer.normal)};
}

DistanceGradients gradients(const PlacedShape& a, const PlacedShape& b, const Vec3& about) {
  DistanceGradients r;
  const Separation s = separation(a, b);
  r.outcome = s.outcome;
  if (s.outcome != Outcome::answered) return r;
  const WideVec from = (about - a.pose.translation).cast<Wide>();
  for (const narrow::ManifoldVertex& v : narrow::manifold_of(a, b, s))
    r.corners.push_back({s.normal.cast<double>(), (v.p - from).cross(s.normal).cast<double>()});
  const bool meets = s.gap <= tolerance::narrow_contact_factor * s.size;
  if (r.corners.size() > 1)
    r.unique = false;
  else if (!meets && !is_mesh(a) && !is_mesh(b))
    r.unique = true;
  return r;
}

}  // namespace touchstone
