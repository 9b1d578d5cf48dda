// A bounded convex body A against a half-space B. Only one direction separates them, so distance and depth
// are both a single support evaluation.
#pragma once

#include "core/narrow/convex_pair.h"

namespace touchstone::narrow {

struct WidePlane {
  WideVec normal;  // unit, pointing out of the solid
  Wide offset;     // solid: normal·x <= offset
};

inline WidePlane place(const HalfSpace& h, const WideFrame& f) {
  const WideVec n = h.normal.cast<Wide>();
  const Wide length = n.norm();
  const WideVec m = (f.rotation * n / length).normalized();
  return {m, m.dot(f.translation) + h.offset / length};
}

inline Separation convex_plane(const ConvexCore<Wide>& a, const WidePlane& plane) {
  Separation s;
  s.normal = -plane.normal;
  s.a = support<Wide>(a, s.normal) + a.radius * s.normal;
  s.gap = plane.normal.dot(s.a) - plane.offset;
  s.b = s.a + s.gap * s.normal;
  s.size = a.reach + a.radius + abs(plane.offset) + a.frame.translation.norm();
  return s;
}

}  // namespace touchstone::narrow
