// Closed axis-aligned box. Touching counts as overlap (truth.md §1).
#pragma once

#include <cmath>
#include <limits>

#include "core/math/pose.h"
#include "core/math/roundoff.h"

namespace touchstone {

struct Aabb {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = Vec3::Constant(-std::numeric_limits<double>::infinity());
  bool operator==(const Aabb& o) const { return lo == o.lo && hi == o.hi; }
  void extend(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  void extend(const Aabb& b) {
    lo = lo.cwiseMin(b.lo);
    hi = hi.cwiseMax(b.hi);
  }
};

inline bool overlaps(const Aabb& a, const Aabb& b) {
  return a.lo.x() <= b.hi.x() && b.lo.x() <= a.hi.x() && a.lo.y() <= b.hi.y() && b.lo.y() <= a.hi.y() &&
         a.lo.z() <= b.hi.z() && b.lo.z() <= a.hi.z();
}

/// Contains every point within `by` >= 0 of the box: each side is moved outward by that, and by the rounding
/// of the sum.
inline Aabb widened(Aabb box, double by) {
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = std::nextafter(box.lo[k] - by, -infinity);
    box.hi[k] = std::nextafter(box.hi[k] + by, infinity);
  }
  return box;
}

}  // namespace touchstone
