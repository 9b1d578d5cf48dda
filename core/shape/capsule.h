// Closed set of the points within `radius` of the segment from (0,0,-half_height) to (0,0,half_height); total
// length 2·(half_height + radius).
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/feature.h"
#include "core/shape/field.h"

namespace touchstone::convex {

/// From (0, 0, −half_height) to (0, 0, half_height).
template <class R>
struct SegmentCore : Polyhedral<R> {
  static constexpr Symmetry symmetry = Symmetry::axis;
  static constexpr int support_rounding = 0;
  R half_height;

  explicit SegmentCore(R h) : half_height(h) {}

  V3<R> support(const V3<R>& d) const { return {0, 0, toward(half_height, d[2])}; }
  R reach() const { return half_height; }
  R extent() const { return half_height; }
  R reach_off_axis(const V3<R>& axis) const { return off_axis<R>({0, 0, half_height}, axis); }
  int round_axis() const { return 2; }
  template <class F>
  void for_each_slant(F&&) const {}
  void scale(R unit) { half_height *= unit; }

  V3<R> snap(const V3<R>& p) const { return {p[0], p[1], toward(half_height, p[2])}; }
  Feature<R> suggest(const std::array<V3<R>, 3>& q, const V3<R>&, const V3<R>&, R) const {
    if (q[0][2] == q[1][2] && q[1][2] == q[2][2]) return corner_feature<R>(q[0]);
    return edge_feature<R>(V3<R>::Zero(), V3<R>::UnitZ(), -half_height, half_height);
  }
  R face_margin(const Feature<R>&, const V3<R>&) const { return 0; }
  template <class Out>
  bool face_corners(const FaceQuery<R>&, Out&& out) const {
    out.add({0, 0, half_height}, 0);
    out.add({0, 0, -half_height}, 1);
    return false;
  }
  template <class Out>
  void edges_within(const FaceQuery<R>& at, Out&& out) const {
    edge_within<R>(at, {0, 0, half_height}, 0, {0, 0, -half_height}, 1, out);
  }
  R edge_reach(const FaceQuery<R>& at) const { return reach_along(at, 2 * half_height, at.d[2]); }
};

}  // namespace touchstone::convex

namespace touchstone {

struct Capsule {
  double radius = 0, half_height = 0;
  static constexpr std::string_view type = "capsule";
  static constexpr auto fields() {
    return std::tuple{Field{"radius", &Capsule::radius, Domain::non_negative},
                      Field{"half_height", &Capsule::half_height, Domain::non_negative}};
  }

  template <class R>
  convex::SegmentCore<R> core() const {
    return convex::SegmentCore<R>(static_cast<R>(half_height));
  }
  static constexpr bool has_ball = true;
  double ball_radius() const { return radius; }
  bool is_ball() const { return false; }
  double bounding_radius() const { return radius + half_height; }
  double extent() const { return radius + half_height; }
  template <class T>
  Interval<T> extent_along(const V3<T>& d) const {
    return both_sides<T>(d.cwiseAbs().z() * static_cast<T>(half_height) + static_cast<T>(radius));
  }
  Wide coordinate_sum() const { return static_cast<Wide>(radius) + half_height; }
  InnerRadii inner_radii() const { return {radius, radius}; }
  bool operator==(const Capsule&) const = default;
};

inline Vec3 support(const Capsule& c, const Vec3& d) {
  const double n = d.norm();
  Vec3 p = n > 0 ? Vec3(d * (c.radius / n)) : Vec3(c.radius, 0, 0);
  p.z() += d.z() < 0 ? -c.half_height : c.half_height;
  return p;
}

}  // namespace touchstone
