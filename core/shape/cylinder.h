// Closed cylinder about the z axis: x² + y² <= radius², |z| <= half_height.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/field.h"

namespace touchstone {

struct Cylinder {
  double radius = 0, half_height = 0;
  static constexpr std::string_view type = "cylinder";
  static constexpr auto fields() {
    return std::tuple{Field{"radius", &Cylinder::radius, Domain::non_negative},
                      Field{"half_height", &Cylinder::half_height, Domain::non_negative}};
  }
  bool operator==(const Cylinder&) const = default;
};

inline Vec3 support(const Cylinder& c, const Vec3& d) {
  const double s = std::hypot(d.x(), d.y());
  const double z = d.z() < 0 ? -c.half_height : c.half_height;
  if (!(s > 0)) return {c.radius, 0, z};
  return {d.x() / s * c.radius, d.y() / s * c.radius, z};
}

}  // namespace touchstone
