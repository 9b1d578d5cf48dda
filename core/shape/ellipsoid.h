// Closed ellipsoid Σ (x_i / semi_axes_i)² <= 1, all semi-axes > 0.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/feature.h"
#include "core/shape/field.h"

namespace touchstone::convex {

template <class R>
struct EllipsoidCore {
  static constexpr bool is_polytope = false;
  static constexpr Symmetry symmetry = Symmetry::none;
  static constexpr int support_rounding = 6;
  std::array<R, 3> semi_axes;

  explicit EllipsoidCore(const V3<R>& s) : semi_axes{s[0], s[1], s[2]} {}
  V3<R> semi() const { return {semi_axes[0], semi_axes[1], semi_axes[2]}; }

  V3<R> support(const V3<R>& d) const {
    const V3<R> s = semi(), e = s.cwiseProduct(d);
    const R n = e.norm();
    return n > 0 ? V3<R>(s.cwiseProduct(e) * (1 / n)) : V3<R>(s[0], 0, 0);
  }
  /// S²/h − p pᵀ/h with p = S² d/h.
  M3<R> support_derivative(const V3<R>& d) const {
    const V3<R> s = semi(), e = s.cwiseProduct(d);
    const R h = e.norm();
    const V3<R> p = s.cwiseProduct(e) / h;
    M3<R> m = M3<R>::Zero();
    m.diagonal() = s.cwiseProduct(s) / h;
    m -= p * p.transpose() / h;
    return m;
  }
  R reach() const { return semi().maxCoeff(); }
  R extent() const { return semi().maxCoeff(); }
  R reach_off_axis(const V3<R>&) const { return reach(); }
  /// The axis about which it is nearest to a solid of revolution.
  int round_axis() const {
    const V3<R> s = semi();
    const R d0 = abs(s[1] - s[2]), d1 = abs(s[2] - s[0]), d2 = abs(s[0] - s[1]);
    return d0 <= d1 && d0 <= d2 ? 0 : (d1 <= d2 ? 1 : 2);
  }
  void scale(R unit) {
    for (R& s : semi_axes) s *= unit;
  }

  V3<R> snap(const V3<R>& p) const { return p; }
  Feature<R> suggest(const std::array<V3<R>, 3>&, const V3<R>&, const V3<R>&, R) const {
    Feature<R> f;
    f.kind = FeatureKind::round;
    return f;
  }
  FeaturePoint<R> locate(const Feature<R>&, const V3<R>& d) const {
    const V3<R> s = semi(), e = s.cwiseProduct(d);
    FeaturePoint<R> r;
    r.h = e.norm();
    r.p = s.cwiseProduct(e) / r.h;
    return r;
  }
  void add_second_derivative(const FeaturePoint<R>& p, const V3<R>& x, const V3<R>& y,
                             TangentForm<R>& form) const {
    if (!(p.h > 0)) return;
    const V3<R> s = semi(), sx = s.cwiseProduct(x), sy = s.cwiseProduct(y);
    const R px = p.p.dot(x), py = p.p.dot(y);
    form.xx += (sx.dot(sx) - px * px) / p.h;
    form.xy += (sx.dot(sy) - px * py) / p.h;
    form.yy += (sy.dot(sy) - py * py) / p.h;
  }
  bool use_disc(Feature<R>&, const V3<R>&) const { return false; }
  void shorten(Feature<R>&, bool) const {}  // has no edges
  R face_margin(const Feature<R>&, const V3<R>&) const { return 0; }
  R edge_share(const Feature<R>&, R) const { return 1; }
  /// In a small cap from |S m|, S the diagonal of the semi-axes: as for a disc, (|S m × S t|)²/X³. Otherwise
  /// from the ball that touches from inside, wherever it is.
  void add_curvature(const Feature<R>&, R, const Tangents<R>& at, const Cap<R>& cap, R share,
                     TangentForm<R>& form) const {
    const V3<R> s = semi();
    if (!(share < R(0.25))) {
      const R least = s.minCoeff();
      return form.add_all(least * least / s.maxCoeff());
    }
    const V3<R> e = s.cwiseProduct(at.m), px = e.cross(s.cwiseProduct(at.x)),
                py = e.cross(s.cwiseProduct(at.y));
    const R most = std::min(s.maxCoeff(), e.norm() + s.maxCoeff() * cap.sine), k = 1 / (most * most * most);
    form.xx += k * px.squaredNorm();
    form.xy += k * px.dot(py);
    form.yy += k * py.squaredNorm();
  }
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

struct Ellipsoid {
  /// A sum of squares below this may have lost digits to underflow.
  /// Tested by: tests/core "loose boxes contain ellipsoids of any size".
  static constexpr double least_square = 0x1p-960;
  Vec3 semi_axes = Vec3::Ones();
  static constexpr std::string_view type = "ellipsoid";
  static constexpr auto fields() {
    return std::tuple{Field{"semi_axes", &Ellipsoid::semi_axes, Domain::positive}};
  }

  template <class R>
  convex::EllipsoidCore<R> core() const {
    return convex::EllipsoidCore<R>(semi_axes.cast<R>());
  }
  static constexpr bool has_ball = false;
  double ball_radius() const { return 0; }
  bool is_ball() const { return (semi_axes.array() == semi_axes[0]).all(); }
  double bounding_radius() const { return semi_axes.maxCoeff(); }
  double extent() const { return semi_axes.maxCoeff(); }
  template <class T>
  Interval<T> extent_along(const V3<T>& d) const {
    const V3<T> scaled = d.cwiseProduct(semi_axes.cast<T>());
    if constexpr (std::is_same_v<T, Wide>)
      return both_sides<T>(wide_norm(scaled));
    else if (const T square = scaled.squaredNorm(); square > least_square)
      return both_sides<T>(std::sqrt(square));
    else
      return both_sides<T>(static_cast<T>(scaled_norm(scaled.template cast<double>())));
  }
  Wide coordinate_sum() const { return semi_axes.cast<Wide>().sum(); }
  InnerRadii inner_radii() const {
    const double r = semi_axes.minCoeff();
    return {r, r};
  }
  bool operator==(const Ellipsoid& o) const { return semi_axes == o.semi_axes; }
};

inline Vec3 support(const Ellipsoid& e, const Vec3& d) {
  const Vec3 s = e.semi_axes.cwiseProduct(d);
  const double n = s.norm();
  return n > 0 ? Vec3(e.semi_axes.cwiseProduct(s) / n) : Vec3(e.semi_axes.x(), 0, 0);
}

}  // namespace touchstone
