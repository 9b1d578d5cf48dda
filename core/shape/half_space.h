// Closed half-space { x : normal·x <= offset }, solid below its plane. `normal` is any non-zero vector: the
// set is exact as written, and the plane lies at distance offset/|normal| from the body's origin.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/field.h"

namespace touchstone {

struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;
  static constexpr std::string_view type = "half_space";
  static constexpr auto fields() {
    return std::tuple{Field{"normal", &HalfSpace::normal, Domain::nonzero_vector},
                      Field{"offset", &HalfSpace::offset, Domain::any}};
  }

  double bounding_radius() const { return std::numeric_limits<double>::infinity(); }
  double extent() const { return 0; }
  template <class T>
  Interval<T> extent_along(const V3<T>&) const {
    return both_sides<T>(std::numeric_limits<T>::infinity());
  }
  Wide coordinate_sum() const { return 0; }
  InnerRadii inner_radii() const { return {bounding_radius(), bounding_radius()}; }
  bool operator==(const HalfSpace& o) const { return normal == o.normal && offset == o.offset; }
};

}  // namespace touchstone
