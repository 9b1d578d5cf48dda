// Closed half-space { x : normal·x <= offset }, solid below its plane. `normal` is any non-zero vector: the
// set is exact as written, and the plane lies at distance offset/|normal| from the body's origin.
#pragma once

#include <tuple>

#include "core/math/pose.h"
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
  bool operator==(const HalfSpace& o) const { return normal == o.normal && offset == o.offset; }
};

}  // namespace touchstone
