// The signed distance of spheres.
#pragma once

#include <stdexcept>

#include "coal/math/transform.h"
#include "coal/shape/geometric_shapes.h"

namespace coal {

struct QueryRequest {
  CoalScalar gjk_tolerance = 1e-6, epa_tolerance = 1e-6;
};
struct DistanceRequest : QueryRequest {};
struct DistanceResult {
  CoalScalar min_distance = 0;
  Vec3s normal = Vec3s::Zero();
  std::array<Vec3s, 2> nearest_points;
};

inline CoalScalar distance(const CollisionGeometry* a, const Transform3s& ta, const CollisionGeometry* b,
                           const Transform3s& tb, const DistanceRequest&, DistanceResult& out) {
  const auto *one = dynamic_cast<const Sphere*>(a), *two = dynamic_cast<const Sphere*>(b);
  if (!one || !two) throw std::logic_error("the stand-in knows spheres only");
  const Vec3s between = tb.getTranslation() - ta.getTranslation();
  out.normal = between.normalized();
  out.min_distance = between.norm() - one->radius - two->radius;
  out.nearest_points = {ta.getTranslation() + one->radius * out.normal,
                        tb.getTranslation() - two->radius * out.normal};
  return out.min_distance;
}

}  // namespace coal
