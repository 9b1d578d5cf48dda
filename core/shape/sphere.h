// Closed ball { |x| <= radius }, centred in the body frame. radius = 0 is a point.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/feature.h"
#include "core/shape/field.h"

namespace touchstone::convex {

/// The body's origin.
template <class R>
struct PointCore : Polyhedral<R> {
  static constexpr Symmetry symmetry = Symmetry::centre;
  static constexpr int support_rounding = 0;

  V3<R> support(const V3<R>&) const { return V3<R>::Zero(); }
  R reach() const { return 0; }
  R extent() const { return 0; }
  R reach_off_axis(const V3<R>&) const { return 0; }
  int round_axis() const { return -1; }
  void scale(R) {}

  V3<R> snap(const V3<R>& p) const { return p; }
  Feature<R> suggest(const std::array<V3<R>, 3>&, const V3<R>&, const V3<R>&, R) const {
    return corner_feature<R>(V3<R>::Zero());
  }
  R face_margin(const Feature<R>&, const V3<R>&) const { return 0; }
  template <class Out>
  bool face_corners(const FaceQuery<R>& at, Out&& out) const {
    out.add(support(at.d), 0);
    return false;
  }
  template <class Out>
  void edges_within(const FaceQuery<R>&, Out&&) const {}
  R edge_reach(const FaceQuery<R>&) const { return 0; }
};

}  // namespace touchstone::convex

namespace touchstone {

struct Sphere {
  double radius = 0;
  static constexpr std::string_view type = "sphere";
  static constexpr auto fields() {
    return std::tuple{Field{"radius", &Sphere::radius, Domain::non_negative}};
  }

  template <class R>
  convex::PointCore<R> core() const {
    return {};
  }
  static constexpr bool has_ball = true;
  double ball_radius() const { return radius; }
  bool is_ball() const { return true; }
  double bounding_radius() const { return radius; }
  double extent() const { return radius; }
  template <class T>
  Interval<T> extent_along(const V3<T>&) const {
    return both_sides<T>(radius);
  }
  Wide coordinate_sum() const { return radius; }
  InnerRadii inner_radii() const { return {radius, radius}; }
  bool operator==(const Sphere&) const = default;
};

/// A point of the shape farthest along `d` (body frame; `d` of any length, zero allowed).
inline Vec3 support(const Sphere& s, const Vec3& d) {
  const double n = d.norm();
  return n > 0 ? Vec3(d * (s.radius / n)) : Vec3(s.radius, 0, 0);
}

}  // namespace touchstone
