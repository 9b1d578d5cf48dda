// A box that contains a placed shape, for adapters of broad phases that take boxes. Shares no code with the
// boxes of the core's broad phases.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/aabb.h"
#include "oracles/abi/plugin_kit.h"

namespace touchstone::kit {

/// More than the roundings of a rotation matrix and of a support, relative to the largest number involved.
inline constexpr double bounds_rounding = 0x1p-44;

namespace bounds_detail {

struct Extent {
  double lower, upper;
};
inline Extent both_sides(double x) { return {-x, x}; }

inline Extent of_vertices(const ts_shape& s, const Vec3& d) {
  Extent all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < s.vertex_count; ++i) {
    const double x = d.dot(vec3(s.vertices + 3 * i));
    all = {std::min(all.lower, x), std::max(all.upper, x)};
  }
  return all;
}

/// Of the shape, along the unit vector d of its own frame.
inline Extent along(const ts_shape& s, const Vec3& d) {
  const double* z = s.size;
  const double disc = std::hypot(d.x(), d.y()) * z[0], rise = std::abs(d.z()) * z[1];
  const double box = std::abs(d.x()) * z[0] + std::abs(d.y()) * z[1] + std::abs(d.z()) * z[2];
  switch (s.kind) {
    case TS_SPHERE:
      return both_sides(z[0]);
    case TS_BOX:
      return both_sides(box);
    case TS_ROUNDED_BOX:
      return both_sides(box + z[3]);
    case TS_CAPSULE:
      return both_sides(z[0] + rise);
    case TS_CYLINDER:
      return both_sides(disc + rise);
    case TS_CONE:
      return {std::min(d.z() * z[1], -d.z() * z[1] - disc), std::max(d.z() * z[1], -d.z() * z[1] + disc)};
    case TS_ELLIPSOID:
      return both_sides(d.cwiseProduct(vec3(z)).stableNorm());
    case TS_HALF_SPACE:
      return both_sides(std::numeric_limits<double>::infinity());
    default:
      return of_vertices(s, d);
  }
}

}  // namespace bounds_detail

/// World frame. Infinite for a half-space.
inline Aabb outer_bounds(const ts_shape& s, const ts_pose& pose) {
  const Pose p = pose_of(pose);
  const Mat3 r = rotation_matrix(p.rotation);
  Aabb out;
  for (int k = 0; k < 3; ++k) {
    const bounds_detail::Extent e = bounds_detail::along(s, r.row(k).transpose());
    const double reach = std::max(std::abs(e.lower), std::abs(e.upper)) + std::abs(p.translation[k]);
    const double margin = std::isfinite(reach) ? bounds_rounding * reach : 0;
    out.lo[k] = p.translation[k] + e.lower - margin;
    out.hi[k] = p.translation[k] + e.upper + margin;
  }
  return out;
}

}  // namespace touchstone::kit
