// Two segments. The nearest pair is either an end of one and a point of the other, or interior points of
// both; in the latter case the normal is u×v. Parameters come from cross products, so that their error grows
// as 1/sin of the angle instead of 1/sin² (the usual normal equations); for nearly parallel segments that
// touch, the latter would ruin the normal.
#pragma once

#include <algorithm>

#include "core/narrow/convex_pair.h"

namespace touchstone::narrow {

inline Separation capsule_capsule(const ConvexCore<Wide>& a, const ConvexCore<Wide>& b) {
  const WideVec u = a.frame.rotation.col(2), v = b.frame.rotation.col(2);
  const WideVec ca = a.frame.translation, cb = b.frame.translation, r = cb - ca;
  const Wide ha = std::get<convex::SegmentCore<Wide>>(a.core).half_height,
             hb = std::get<convex::SegmentCore<Wide>>(b.core).half_height;
  WideVec pa = ca, pb = cb, normal = u.unitOrthogonal();
  Wide best = std::numeric_limits<Wide>::infinity();
  const auto consider = [&](Wide s, Wide t, bool inner_s, bool inner_t) {
    const WideVec x = ca + s * u, y = cb + t * v;
    WideVec d = y - x;
    if (inner_s) d -= u * u.dot(d);
    if (inner_t) d -= v * v.dot(d);
    const Wide n = d.norm();
    if (!(n < best)) return;
    best = n;
    pa = x;
    pb = y;
    if (n > 0) normal = d / n;
  };
  for (const Wide s : {-ha, ha}) {
    const Wide t = (ca + s * u - cb).dot(v);
    consider(s, std::clamp<Wide>(t, -hb, hb), false, abs(t) < hb);
  }
  for (const Wide t : {-hb, hb}) {
    const Wide s = (cb + t * v - ca).dot(u);
    consider(std::clamp<Wide>(s, -ha, ha), t, abs(s) < ha, false);
  }
  const WideVec n = u.cross(v);
  const Wide nn = n.squaredNorm();
  // Below this sin² of the angle, the ends give the distance to within rounding.
  if (nn > std::numeric_limits<Wide>::epsilon() * std::numeric_limits<Wide>::epsilon()) {
    const Wide s = r.cross(v).dot(n) / nn, t = r.cross(u).dot(n) / nn;
    if (abs(s) <= ha && abs(t) <= hb) {
      const Wide d = r.dot(n);
      pa = ca + s * u;
      pb = cb + t * v;
      normal = (d < 0 ? WideVec(-n) : n) / sqrt(nn);
    }
  }
  return certified_or_general(a, b, pa, pb, normal);
}

}  // namespace touchstone::narrow
