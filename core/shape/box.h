// Closed box { |x_i| <= half_extents_i }. A zero half extent gives a rectangle, a segment or a point.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/feature.h"
#include "core/shape/field.h"

namespace touchstone::convex {

template <class R>
struct BoxCore : Polyhedral<R> {
  static constexpr Symmetry symmetry = Symmetry::none;
  static constexpr int support_rounding = 0;
  std::array<R, 3> half_extents;

  explicit BoxCore(const V3<R>& h) : half_extents{h[0], h[1], h[2]} {}
  V3<R> half() const { return {half_extents[0], half_extents[1], half_extents[2]}; }

  V3<R> support(const V3<R>& d) const {
    const auto& h = half_extents;
    return {toward(h[0], d[0]), toward(h[1], d[1]), toward(h[2], d[2])};
  }
  R reach() const { return half().norm(); }
  R extent() const { return half().maxCoeff(); }
  R reach_off_axis(const V3<R>& axis) const {
    const V3<R> h = half();
    return std::max(std::max(off_axis<R>(h, axis), off_axis<R>({-h[0], h[1], h[2]}, axis)),
                    std::max(off_axis<R>({h[0], -h[1], h[2]}, axis), off_axis<R>({h[0], h[1], -h[2]}, axis)));
  }
  int round_axis() const { return -1; }
  void scale(R unit) {
    for (R& h : half_extents) h *= unit;
  }

  V3<R> snap(const V3<R>& p) const { return support(p); }
  /// Decided by the coordinates in which the corners differ.
  Feature<R> suggest(const std::array<V3<R>, 3>& q, const V3<R>&, const V3<R>& d, R near) const {
    const DistinctPoints<R> k(q, near);
    if (k.size == 1) return corner_feature<R>(k.p[0]);
    int axes = 0, axis = 0, same = 0;
    for (int i = 0; i < 3; ++i) {
      if (k.p[0][i] != k.p[1][i] || (k.size == 3 && k.p[0][i] != k.p[2][i])) {
        ++axes;
        axis = i;
      } else {
        same = i;
      }
    }
    if (axes == 1) {
      V3<R> p = k.p[0];
      p[axis] = 0;
      const R h = half()[axis];
      return edge_feature<R>(p, V3<R>::Unit(axis), -h, h);
    }
    if (axes == 2) return face_feature<R>(k.p[0], V3<R>::Unit(same) * (k.p[0][same] < 0 ? R(-1) : R(1)));
    return corner_feature<R>(support(d));
  }
  R face_margin(const Feature<R>& f, const V3<R>& q) const {
    R least = std::numeric_limits<R>::infinity();
    for (int k = 0; k < 3; ++k)
      if (f.c[k] == 0) least = std::min(least, half()[k] - abs(q[k]));
    return least;
  }
  template <class Out>
  bool face_corners(const FaceQuery<R>& at, Out&& out) const {
    const V3<R>&d = at.d, h = half();
    int free[3], frees = 0;
    for (int k = 0; k < 3; ++k) {
      // Across a flat box the corners coincide: four of them do not form a face.
      if (h[k] > at.tolerance && 2 * abs(d[k]) * h[k] <= at.limit) free[frees++] = k;
    }
    const auto show = [&](unsigned bits) { out.add(corner(bits), bits); };
    if (frees == 3) {
      for (unsigned bits = 0; bits < 8; ++bits) show(bits);
      return false;
    }
    const unsigned top = support_bits(d);
    show(top);
    if (frees == 0) return false;
    const unsigned p = 1u << free[0];
    show(top ^ p);
    if (frees == 1) return false;
    const unsigned q = 1u << free[1];
    show(top ^ p ^ q);
    show(top ^ q);
    return true;
  }
  template <class Out>
  void edges_within(const FaceQuery<R>& at, Out&& out) const {
    const V3<R> height = 2 * at.d.cwiseAbs().cwiseProduct(half());
    const unsigned top = support_bits(at.d);
    // Downwards from the support corner: `far` has the axes along which a corner is on the other side.
    for (unsigned far = 0; far < 7; ++far) {
      R below = 0;
      for (int k = 0; k < 3; ++k)
        if (far >> k & 1) below += height[k];
      if (below > at.limit) continue;
      const unsigned from = top ^ far;
      out.from(corner(from), from);
      for (int k = 0; k < 3; ++k) {
        if (far >> k & 1) continue;
        const R share = below + height[k] <= at.limit ? R(1) : (at.limit - below) / height[k];
        out.to(corner(from ^ 1u << k), from ^ 1u << k, share);
      }
    }
  }
  R edge_reach(const FaceQuery<R>& at) const {
    R most = 0;
    for (int k = 0; k < 3; ++k) most = std::max(most, reach_along(at, 2 * half()[k], at.d[k]));
    return most;
  }

 private:
  static unsigned support_bits(const V3<R>& d) {
    unsigned bits = 0;
    for (int k = 0; k < 3; ++k)
      if (d[k] >= 0) bits |= 1u << k;
    return bits;
  }
  // Bit k is set on the positive side of axis k.
  V3<R> corner(unsigned bits) const {
    const V3<R> h = half();
    return {bits & 1 ? h[0] : -h[0], bits & 2 ? h[1] : -h[1], bits & 4 ? h[2] : -h[2]};
  }
};

}  // namespace touchstone::convex

namespace touchstone {

struct Box {
  Vec3 half_extents = Vec3::Zero();
  static constexpr std::string_view type = "box";
  static constexpr auto fields() {
    return std::tuple{Field{"half_extents", &Box::half_extents, Domain::non_negative}};
  }

  template <class R>
  convex::BoxCore<R> core() const {
    return convex::BoxCore<R>(half_extents.cast<R>());
  }
  static constexpr bool has_ball = false;
  double ball_radius() const { return 0; }
  bool is_ball() const { return false; }
  double bounding_radius() const { return scaled_norm(half_extents); }
  double extent() const { return half_extents.maxCoeff(); }
  template <class T>
  Interval<T> extent_along(const V3<T>& d) const {
    return both_sides<T>(d.cwiseAbs().dot(half_extents.cast<T>()));
  }
  Wide coordinate_sum() const { return half_extents.cast<Wide>().sum(); }
  InnerRadii inner_radii() const {
    const double r = half_extents.minCoeff();
    return {r, r};
  }
  bool operator==(const Box& o) const { return half_extents == o.half_extents; }
};

inline Vec3 support(const Box& b, const Vec3& d) {
  const Vec3& h = b.half_extents;
  return {d.x() < 0 ? -h.x() : h.x(), d.y() < 0 ? -h.y() : h.y(), d.z() < 0 ? -h.z() : h.z()};
}

}  // namespace touchstone
