#include "core/shape/bounds.h"

namespace touchstone {

Wide largest_coordinate_sum(const std::vector<Vec3>& points) {
  Wide r = 0;
  for (const Vec3& p : points) r = std::max(r, p.cast<Wide>().lpNorm<1>());
  return r;
}

double scaled_norm(const Vec3& v) { return v.stableNorm(); }

double farthest(const std::vector<Vec3>& points) {
  double r = 0;
  for (const Vec3& p : points) r = std::max(r, p.stableNorm());
  return r;
}

double largest_half_extent(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  Vec3 lo = points.front(), hi = points.front();
  for (const Vec3& p : points) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  return (hi - lo).maxCoeff() / 2;
}

}  // namespace touchstone
