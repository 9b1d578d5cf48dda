// Closed ball { |x| <= radius }, centred in the body frame. radius = 0 is a point.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/field.h"

namespace touchstone {

struct Sphere {
  double radius = 0;
  static constexpr std::string_view type = "sphere";
  static constexpr auto fields() { return std::tuple{Field{"radius", &Sphere::radius, Domain::non_negative}}; }
  bool operator==(const Sphere&) const = default;
};

/// A point of the shape farthest along `d` (body frame; `d` of any length, zero allowed).
inline Vec3 support(const Sphere& s, const Vec3& d) {
  const double n = d.norm();
  return n > 0 ? Vec3(d * (s.radius / n)) : Vec3(s.radius, 0, 0);
}

}  // namespace touchstone
