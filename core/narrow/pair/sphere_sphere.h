// Two balls: the distance of two points. For concentric balls every direction is a minimum; x is returned.
#pragma once

#include "core/narrow/convex_pair.h"

namespace touchstone::narrow {

inline Separation sphere_sphere(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b) {
  const WideVec pa = a.frame.translation, pb = b.frame.translation, v = pb - pa;
  const Wide d = v.norm();
  return certified_or_general(a, b, pa, pb, d > 0 ? WideVec(v / d) : WideVec::UnitX());
}

}  // namespace touchstone::narrow
