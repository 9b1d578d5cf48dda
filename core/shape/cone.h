// Closed cone about the z axis: apex (0,0,half_height), base disc of `radius` at z = -half_height. The origin
// is at mid height, not at the centroid.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/feature.h"
#include "core/shape/field.h"
#include "core/shape/rim.h"

namespace touchstone::convex {

template <class R>
struct ConeCore {
  static constexpr bool is_polytope = false;
  static constexpr Symmetry symmetry = Symmetry::axis;
  static constexpr int support_rounding = 6;
  R radius, half_height;

  V3<R> support(const V3<R>& d) const {
    return is_apex(d, flat_length(d)) ? apex() : rim_support(radius, -half_height, d);
  }
  M3<R> support_derivative(const V3<R>& d) const {
    return is_apex(d, flat_length(d)) ? M3<R>(M3<R>::Zero()) : rim_derivative(radius, d);
  }
  R reach() const { return rim_reach(radius, half_height); }
  R extent() const { return std::max(radius, half_height); }
  R reach_off_axis(const V3<R>& axis) const { return std::min(reach(), radius + off_axis<R>(apex(), axis)); }
  int round_axis() const { return 2; }
  /// The side's outward normal in the section: away from the axis, and along z.
  template <class F>
  void for_each_slant(F&& f) const {
    const R h = 2 * half_height, length = sqrt(radius * radius + h * h);
    f(h / length, radius / length);
  }
  void scale(R unit) {
    radius *= unit;
    half_height *= unit;
  }

  V3<R> snap(const V3<R>& p) const { return {p[0], p[1], toward(half_height, p[2])}; }
  Feature<R> suggest(const std::array<V3<R>, 3>& q, const V3<R>& foot, const V3<R>&, R) const {
    if (q[0][2] == q[1][2] && q[1][2] == q[2][2])
      return q[0][2] > 0 ? corner_feature<R>(q[0]) : rim_or_disc(radius, q[0], foot);
    const R length = sqrt(radius * radius + 4 * half_height * half_height);
    Feature<R> f = edge_feature<R>(apex(), V3<R>::UnitZ(), 0, length);
    f.s = radius / length;
    f.k = 2 * half_height / length;
    return f;
  }
  FeaturePoint<R> locate(Feature<R>& f, const V3<R>& d) const {
    if (f.kind == FeatureKind::round) return rim_point<R>(radius, f.p, d);
    if (f.kind == FeatureKind::edge) {
      const V3<R> out = radial(d, flat_length(d));
      f.e = V3<R>(radius * out[0], radius * out[1], -2 * half_height) / f.hi;
    }
    return fixed_point(f);
  }
  void add_second_derivative(const FeaturePoint<R>& p, const V3<R>& x, const V3<R>& y,
                             TangentForm<R>& form) const {
    form.add(p.k, p.t.dot(x), p.t.dot(y));
  }
  bool use_disc(Feature<R>& f, const V3<R>& d) const { return rim_to_disc(f, d); }
  void shorten(Feature<R>& f, bool high) const {
    f.p = high ? V3<R>(0, 0, -half_height) : V3<R>(f.p + f.lo * f.e);
    f.kind = high ? FeatureKind::round : FeatureKind::corner;
  }
  R face_margin(const Feature<R>&, const V3<R>& q) const { return radius - flat_length(q); }
  // Discs and generators are not summands of a cone, but part of one is together with the rest of the other.
  R edge_share(const Feature<R>& f, R share) const { return f.kind == FeatureKind::edge ? share : R(1); }
  void add_curvature(const Feature<R>& f, R along, const Tangents<R>& at, const Cap<R>& cap, R share,
                     TangentForm<R>& form) const {
    if (f.kind == FeatureKind::edge) add_rim_curvature(radius * along / f.hi * (1 - share), at, cap, form);
    if (f.kind == FeatureKind::round) add_rim_curvature(radius, at, cap, form);
  }
  template <class Out>
  bool face_corners(const FaceQuery<R>& at, Out&& out) const {
    out.add(apex(), 0);
    if (has_whole_rim(at))
      add_rim_corners(radius, -half_height, at, 1, 2, out);
    else if (flat_length(at.d) > 0)
      out.add(rim_support(radius, -half_height, at.d), 1);
    return false;
  }
  // The generator through the support point, unless the whole rim is within the limit.
  template <class Out>
  void edges_within(const FaceQuery<R>& at, Out&& out) const {
    if (flat_length(at.d) > 0 && !has_whole_rim(at))
      edge_within<R>(at, apex(), 0, rim_support(radius, -half_height, at.d), 1, out);
  }
  R edge_reach(const FaceQuery<R>&) const { return 2 * half_height + radius; }

 private:
  bool has_whole_rim(const FaceQuery<R>& at) const {
    return at.top + half_height * at.d[2] + radius * flat_length(at.d) <= at.limit;
  }
  V3<R> apex() const { return {0, 0, half_height}; }
  bool is_apex(const V3<R>& d, R flat) const { return d[2] * 2 * half_height > radius * flat; }
};

}  // namespace touchstone::convex

namespace touchstone {

struct Cone {
  double radius = 0, half_height = 0;
  static constexpr std::string_view type = "cone";
  static constexpr auto fields() {
    return std::tuple{Field{"radius", &Cone::radius, Domain::non_negative},
                      Field{"half_height", &Cone::half_height, Domain::non_negative}};
  }

  template <class R>
  convex::ConeCore<R> core() const {
    return {static_cast<R>(radius), static_cast<R>(half_height)};
  }
  static constexpr bool has_ball = false;
  double ball_radius() const { return 0; }
  bool is_ball() const { return false; }
  double bounding_radius() const { return std::hypot(radius, half_height); }
  double extent() const { return std::max(radius, half_height); }
  template <class T>
  Interval<T> extent_along(const V3<T>& d) const {
    const T apex = d.z() * static_cast<T>(half_height), r = static_cast<T>(radius) * convex::flat_length(d);
    return {std::min(apex, -apex - r), std::max(apex, -apex + r)};
  }
  Wide coordinate_sum() const { return 2 * static_cast<Wide>(radius) + half_height; }
  /// In the triangle with half base R and height H: its incircle; about the origin, at half height, the
  /// distances to base and side.
  InnerRadii inner_radii() const {
    const double height = 2 * half_height, side = std::hypot(radius, height);
    if (!(side > 0)) return {};
    return {radius * height / (radius + side), std::min(half_height, radius / 2 * height / side)};
  }
  bool operator==(const Cone&) const = default;
};

inline Vec3 support(const Cone& c, const Vec3& d) {
  const double s = std::hypot(d.x(), d.y());
  if (d.z() * 2 * c.half_height > c.radius * s) return {0, 0, c.half_height};
  if (!(s > 0)) return {c.radius, 0, -c.half_height};
  return {d.x() / s * c.radius, d.y() / s * c.radius, -c.half_height};
}

}  // namespace touchstone
