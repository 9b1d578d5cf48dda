// Closed set of the points within `radius` of the box { |x_i| <= half_extents_i }; total lengths
// 2·(half_extents_i + radius). Radius 0 gives a box, half extents of zero a sphere.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/box.h"
#include "core/shape/field.h"

namespace touchstone {

struct RoundedBox {
  Vec3 half_extents = Vec3::Zero();
  double radius = 0;
  static constexpr std::string_view type = "rounded_box";
  static constexpr auto fields() {
    return std::tuple{Field{"half_extents", &RoundedBox::half_extents, Domain::non_negative},
                      Field{"radius", &RoundedBox::radius, Domain::non_negative}};
  }

  template <class R>
  convex::BoxCore<R> core() const {
    return convex::BoxCore<R>(half_extents.cast<R>());
  }
  static constexpr bool has_ball = true;
  double ball_radius() const { return radius; }
  bool is_ball() const { return half_extents.isZero(0); }
  double bounding_radius() const { return scaled_norm(half_extents) + radius; }
  double extent() const { return half_extents.maxCoeff() + radius; }
  template <class T>
  Interval<T> extent_along(const V3<T>& d) const {
    return both_sides<T>(d.cwiseAbs().dot(half_extents.cast<T>()) + static_cast<T>(radius));
  }
  Wide coordinate_sum() const { return half_extents.cast<Wide>().sum() + radius; }
  InnerRadii inner_radii() const {
    const double r = half_extents.minCoeff() + radius;
    return {r, r};
  }
  bool operator==(const RoundedBox& o) const { return half_extents == o.half_extents && radius == o.radius; }
};

inline Vec3 support(const RoundedBox& b, const Vec3& d) {
  const double n = d.norm();
  const Vec3 ball = n > 0 ? Vec3(d * (b.radius / n)) : Vec3(b.radius, 0, 0);
  const Vec3& h = b.half_extents;
  return ball + Vec3(d.x() < 0 ? -h.x() : h.x(), d.y() < 0 ? -h.y() : h.y(), d.z() < 0 ? -h.z() : h.z());
}

}  // namespace touchstone
