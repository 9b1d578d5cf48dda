// Closed set of the points within `radius` of the segment from (0,0,-half_height) to (0,0,half_height); total
// length 2·(half_height + radius).
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/field.h"

namespace touchstone {

struct Capsule {
  double radius = 0, half_height = 0;
  static constexpr std::string_view type = "capsule";
  static constexpr auto fields() {
    return std::tuple{Field{"radius", &Capsule::radius, Domain::non_negative},
                      Field{"half_height", &Capsule::half_height, Domain::non_negative}};
  }
  bool operator==(const Capsule&) const = default;
};

inline Vec3 support(const Capsule& c, const Vec3& d) {
  const double n = d.norm();
  Vec3 p = n > 0 ? Vec3(d * (c.radius / n)) : Vec3(c.radius, 0, 0);
  p.z() += d.z() < 0 ? -c.half_height : c.half_height;
  return p;
}

}  // namespace touchstone
