#pragma once

#include <limits>

#include "coal/distance.h"

namespace coal {

struct CollisionRequest : QueryRequest {
  CoalScalar security_margin = 0;
  bool enable_distance_lower_bound = false;
};
struct Contact {
  Vec3s normal, pos;
  CoalScalar penetration_depth;
};
class CollisionResult {
 public:
  CoalScalar distance_lower_bound = std::numeric_limits<CoalScalar>::max();
  bool isCollision() const { return !contacts_.empty(); }
  const Contact& getContact(std::size_t i) const { return contacts_[i]; }
  void addContact(const Contact& c) { contacts_.push_back(c); }

 private:
  std::vector<Contact> contacts_;
};

inline std::size_t collide(const CollisionGeometry* a, const Transform3s& ta, const CollisionGeometry* b,
                           const Transform3s& tb, const CollisionRequest& request, CollisionResult& out) {
  DistanceResult r;
  const CoalScalar d = distance(a, ta, b, tb, {}, r);
  if (request.enable_distance_lower_bound) out.distance_lower_bound = d;
  if (d > request.security_margin) return 0;
  out.addContact({r.normal, (r.nearest_points[0] + r.nearest_points[1]) / 2, r.min_distance});
  return 1;
}

}  // namespace coal
