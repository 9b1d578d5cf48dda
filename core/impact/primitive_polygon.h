// The difference set of two primitives whose vertices move on straight paths: v − f for a vertex and a face,
// b − a for two edges. It is a triangle or a parallelogram whose corners also move on straight paths, and the
// primitives meet at t exactly when it contains the origin at t.
//
// Error model, u = 2⁻⁵³. A corner component is one difference of two doubles: relative error u, correct sign.
// With M_c >= |component c| of every corner at both ends, a corner at a time t that is a double,
// (1 − t)·start + t·end, has errors u·M_c of the corner, u·M_c of 1 − t, u·M_c of the products, u·M_c of the
// sum: at most 4.1u·M_c.
#pragma once

#include <array>
#include <cstddef>

#include "core/impact/primitive_impact.h"
#include "core/math/roundoff.h"

namespace touchstone::impact {

struct MovingPolygon {
  std::size_t corners = 3;         // in cyclic order
  std::array<Vec3, 4> start, end;  // at t = 0 and t = 1
  Vec3 size = Vec3::Zero();        // M_c
};

using Corners = std::array<Vec3, 4>;

/// In u·M_c: more than the error of a corner (above), by which a true component may exceed the computed one.
inline constexpr int corner_rounding = 8;

MovingPolygon difference_polygon(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                                 const std::array<Vec3, 4>& end);

inline Corners corners_at(const MovingPolygon& p, double t) {
  Corners w;
  for (std::size_t k = 0; k < p.corners; ++k) w[k] = (1 - t) * p.start[k] + t * p.end[k];
  return w;
}

/// Bound of the true corners' |components| at two times, from the computed corners.
inline Vec3 local_size(const MovingPolygon& p, const Corners& from, const Corners& to) {
  Vec3 l = Vec3::Zero();
  for (std::size_t k = 0; k < p.corners; ++k) l = l.cwiseMax(from[k].cwiseAbs()).cwiseMax(to[k].cwiseAbs());
  return l + corner_rounding * double_roundoff * p.size;
}

}  // namespace touchstone::impact
