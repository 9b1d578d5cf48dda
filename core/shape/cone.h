// Closed cone about the z axis: apex (0,0,half_height), base disc of `radius` at z = -half_height. The origin
// is at mid height, not at the centroid.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/field.h"

namespace touchstone {

struct Cone {
  double radius = 0, half_height = 0;
  static constexpr std::string_view type = "cone";
  static constexpr auto fields() {
    return std::tuple{Field{"radius", &Cone::radius, Domain::non_negative},
                      Field{"half_height", &Cone::half_height, Domain::non_negative}};
  }
  bool operator==(const Cone&) const = default;
};

inline Vec3 support(const Cone& c, const Vec3& d) {
  const double s = std::hypot(d.x(), d.y());
  if (d.z() * 2 * c.half_height > c.radius * s) return {0, 0, c.half_height};
  if (!(s > 0)) return {c.radius, 0, -c.half_height};
  return {d.x() / s * c.radius, d.y() / s * c.radius, -c.half_height};
}

}  // namespace touchstone
