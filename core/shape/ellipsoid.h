// Closed ellipsoid Σ (x_i / semi_axes_i)² <= 1, all semi-axes > 0.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/field.h"

namespace touchstone {

struct Ellipsoid {
  Vec3 semi_axes = Vec3::Ones();
  static constexpr std::string_view type = "ellipsoid";
  static constexpr auto fields() {
    return std::tuple{Field{"semi_axes", &Ellipsoid::semi_axes, Domain::positive}};
  }
  bool operator==(const Ellipsoid& o) const { return semi_axes == o.semi_axes; }
};

inline Vec3 support(const Ellipsoid& e, const Vec3& d) {
  const Vec3 s = e.semi_axes.cwiseProduct(d);
  const double n = s.norm();
  return n > 0 ? Vec3(e.semi_axes.cwiseProduct(s) / n) : Vec3(e.semi_axes.x(), 0, 0);
}

}  // namespace touchstone
