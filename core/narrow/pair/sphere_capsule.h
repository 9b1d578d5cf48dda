// A point and a segment. If the foot is inside the segment, the difference is made orthogonal to the segment
// before it is normalised: any component along the segment, however small, changes the depth by half the
// segment's length times that component.
#pragma once

#include <algorithm>

#include "core/narrow/convex_pair.h"

namespace touchstone::narrow {

inline Separation sphere_capsule(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b) {
  const WideVec u = b.frame.rotation.col(2), p = a.frame.translation, r = p - b.frame.translation;
  const Wide h = std::get<convex::SegmentCore<Wide>>(b.core).half_height,
             s = std::clamp<Wide>(r.dot(u), -h, h);
  const WideVec q = b.frame.translation + s * u;
  WideVec v = q - p;
  if (abs(s) < h) v -= u * u.dot(v);
  const Wide d = v.norm();
  return certified_or_general(a, b, p, q, d > 0 ? WideVec(v / d) : WideVec(u.unitOrthogonal()));
}

}  // namespace touchstone::narrow
