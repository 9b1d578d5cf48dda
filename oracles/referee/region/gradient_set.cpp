// Derivation: for one normal n, the gap of the planes across n that support A and B is -h_A(n) - h_B(-n), of
// which the signed distance is the maximum over n. To first order in the pose of B, and with the best tilt of
// n, its change is the support function of the region where the two features face each other: the least
// change of the gap between the planes over the region's points. That is reached at its corners.
#include "oracles/referee/region/gradient_set.h"

#include "oracles/referee/filter/body.h"
#include "oracles/referee/region/contact_region.h"

namespace touchstone::referee {

GradientSet gradient_set(const Placed& a, const Placed& b, std::span<const Vec3> normals, bool complete,
                         double l) {
  const Vec3 origin = translation_of(b);
  GradientSet r;
  bool points = true;
  for (const Vec3& n : normals) {
    const ContactRegion region = contact_region(a, b, n, gradient_slack_factor * l);
    points &= region.kind == ContactRegion::Kind::point;
    for (const Vec3& p : region.vertices) r.corners.push_back({n, (p - origin).cross(n), p});
  }
  r.unique = complete && normals.size() == 1 && points;
  return r;
}

}  // namespace touchstone::referee
