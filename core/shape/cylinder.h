// Closed cylinder about the z axis: x² + y² <= radius², |z| <= half_height.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/feature.h"
#include "core/shape/field.h"
#include "core/shape/rim.h"

namespace touchstone::convex {

template <class R>
struct CylinderCore {
  static constexpr bool is_polytope = false;
  static constexpr Symmetry symmetry = Symmetry::axis;
  static constexpr int support_rounding = 6;
  R radius, half_height;

  V3<R> support(const V3<R>& d) const { return rim_support(radius, toward(half_height, d[2]), d); }
  M3<R> support_derivative(const V3<R>& d) const { return rim_derivative(radius, d); }
  R reach() const { return rim_reach(radius, half_height); }
  R extent() const { return std::max(radius, half_height); }
  R reach_off_axis(const V3<R>& axis) const {
    return std::min(reach(), radius + off_axis<R>({0, 0, half_height}, axis));
  }
  int round_axis() const { return 2; }
  template <class F>
  void for_each_slant(F&&) const {}
  void scale(R unit) {
    radius *= unit;
    half_height *= unit;
  }

  V3<R> snap(const V3<R>& p) const { return {p[0], p[1], toward(half_height, p[2])}; }
  Feature<R> suggest(const std::array<V3<R>, 3>& q, const V3<R>& foot, const V3<R>&, R) const {
    if (q[0][2] == q[1][2] && q[1][2] == q[2][2]) return rim_or_disc(radius, q[0], foot);
    return edge_feature<R>(V3<R>::Zero(), V3<R>::UnitZ(), -half_height, half_height);
  }
  FeaturePoint<R> locate(const Feature<R>& f, const V3<R>& d) const {
    const bool curved = f.kind == FeatureKind::edge || f.kind == FeatureKind::round;
    return curved ? rim_point<R>(radius, f.p, d) : fixed_point(f);
  }
  void add_second_derivative(const FeaturePoint<R>& p, const V3<R>& x, const V3<R>& y,
                             TangentForm<R>& form) const {
    form.add(p.k, p.t.dot(x), p.t.dot(y));
  }
  bool use_disc(Feature<R>& f, const V3<R>& d) const { return rim_to_disc(f, d); }
  void shorten(Feature<R>& f, bool high) const {
    f.p = V3<R>(0, 0, high ? half_height : -half_height);
    f.kind = FeatureKind::round;
  }
  R face_margin(const Feature<R>&, const V3<R>& q) const { return radius - flat_length(q); }
  R edge_share(const Feature<R>&, R) const { return 1; }
  void add_curvature(const Feature<R>& f, R, const Tangents<R>& at, const Cap<R>& cap, R,
                     TangentForm<R>& form) const {
    if (f.kind == FeatureKind::round || f.kind == FeatureKind::edge) add_rim_curvature(radius, at, cap, form);
  }
  template <class Out>
  bool face_corners(const FaceQuery<R>& at, Out&& out) const {
    const V3<R>& d = at.d;
    const R flat = flat_length(d), z = toward(half_height, d[2]);
    if (2 * flat * radius <= at.limit) {
      constexpr std::uint32_t first = 2, corners = rim_corners;
      add_rim_corners(radius, z, at, z > 0 ? 0 : 1, z > 0 ? first : first + corners, out);
    } else {
      out.add(rim_support(radius, half_height, d), 0);
      out.add(rim_support(radius, -half_height, d), 1);
    }
    return false;
  }
  // The generator through the support point, unless a whole rim is within the limit.
  template <class Out>
  void edges_within(const FaceQuery<R>& at, Out&& out) const {
    const R flat = flat_length(at.d), k = flat > 0 ? radius / flat : R(0);
    if (2 * flat * radius <= at.limit) return;
    edge_within<R>(at, {at.d[0] * k, at.d[1] * k, half_height}, 0, {at.d[0] * k, at.d[1] * k, -half_height},
                   1, out);
  }
  R edge_reach(const FaceQuery<R>& at) const { return reach_along(at, 2 * half_height, at.d[2]); }
};

}  // namespace touchstone::convex

namespace touchstone {

struct Cylinder {
  double radius = 0, half_height = 0;
  static constexpr std::string_view type = "cylinder";
  static constexpr auto fields() {
    return std::tuple{Field{"radius", &Cylinder::radius, Domain::non_negative},
                      Field{"half_height", &Cylinder::half_height, Domain::non_negative}};
  }

  template <class R>
  convex::CylinderCore<R> core() const {
    return {static_cast<R>(radius), static_cast<R>(half_height)};
  }
  static constexpr bool has_ball = false;
  double ball_radius() const { return 0; }
  bool is_ball() const { return false; }
  double bounding_radius() const { return std::hypot(radius, half_height); }
  double extent() const { return std::max(radius, half_height); }
  template <class T>
  Interval<T> extent_along(const V3<T>& d) const {
    return both_sides<T>(d.cwiseAbs().z() * static_cast<T>(half_height) +
                         static_cast<T>(radius) * convex::flat_length(d));
  }
  Wide coordinate_sum() const { return 2 * static_cast<Wide>(radius) + half_height; }
  InnerRadii inner_radii() const {
    const double r = std::min(radius, half_height);
    return {r, r};
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
