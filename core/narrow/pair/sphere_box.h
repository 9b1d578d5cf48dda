// A point and a box, in the box's frame. For a point inside, the nearest face gives the exact least depth.
#pragma once

#include "core/narrow/convex_pair.h"

namespace touchstone::narrow {

inline Separation sphere_box(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b) {
  const WideVec p = b.frame.rotation.transpose() * (a.frame.translation - b.frame.translation);
  const WideVec h = std::get<convex::BoxCore<Wide>>(b.core).half(), q = p.cwiseMax(-h).cwiseMin(h);
  if (const Wide d = (q - p).norm(); d > 0)
    return certified_or_general(a, b, a.frame.translation, b.frame.rotation * q + b.frame.translation,
                                b.frame.rotation * WideVec((q - p) / d));
  int axis = 0;
  const Wide depth = (h - p.cwiseAbs()).minCoeff(&axis);
  const Wide side = p[axis] < 0 ? -1 : 1;
  Separation s;
  s.size = pair_size(a, b);
  s.gap = -depth - a.radius;
  s.normal = -side * b.frame.rotation.col(axis);
  s.a = a.frame.translation + a.radius * s.normal;
  s.b = a.frame.translation - depth * s.normal;
  return s;
}

}  // namespace touchstone::narrow
