// What searches ask of a convex core (a shape without its ball) besides its support mapping: the feature that
// touches along a direction, and how the support point moves there. A direction held by an edge stays on a
// circle of directions, one held by a face is fixed; along round parts the support point moves smoothly.
#pragma once

#include <array>
#include <type_traits>

#include "core/math/wide.h"

namespace touchstone::convex {

// Unqualified calls below also find the functions of a scalar that is a class.
using std::abs;
using std::sqrt;

/// double and float, in which vertices are searched by SIMD and along a hull's graph; in other scalars, all
/// of them are scanned.
template <class R>
inline constexpr bool is_hardware = std::is_same_v<R, double> || std::is_same_v<R, float>;

/// Of a core under rotations about its origin. axis: a solid of revolution about z whose section through the
/// axis is a polygon. centre: every rotation leaves it as it is.
enum class Symmetry { none, axis, centre };

/// corner; edge, or the straight line of a round side; flat face; round part.
enum class FeatureKind { corner, edge, face, round };

/// A feature of one core, in its own frame. Members not listed for a kind are unset.
template <class R>
struct Feature {
  FeatureKind kind = FeatureKind::corner;
  /// Corner; edge: its point at parameter 0 (for a round side, of its axis; for a cone, the apex).
  V3<R> p = V3<R>::Zero();
  V3<R> e = V3<R>::Zero();      // edge: unit; cones: set by locate()
  R lo = 0, hi = 0;             // edge: parameters of its ends
  V3<R> c = V3<R>::Zero();      // edge: its directions d satisfy d·c = s; face: outward normal
  R s = 0, k = 1;               // k = √(1 − s²), stored because s close to 1 loses it
  std::array<V3<R>, 3> corner;  // face of vertices
};

/// Support point and its derivative, H = k t tᵀ + (diagonal of squares − p pᵀ)/h, which the Newton step
/// needs.
template <class R>
struct FeaturePoint {
  V3<R> p;                  // on the feature
  V3<R> t = V3<R>::Zero();  // tangent of a rim
  R k = 0;                  // its radius over the sine of the axis
  R h = 0;                  // ellipsoids: d·p
};

template <class R>
Feature<R> corner_feature(const V3<R>& p) {
  Feature<R> f;
  f.p = p;
  return f;
}

template <class R>
Feature<R> edge_feature(const V3<R>& p, const V3<R>& e, R lo, R hi) {
  Feature<R> f;
  f.kind = FeatureKind::edge;
  f.p = p;
  f.e = f.c = e;
  f.lo = lo;
  f.hi = hi;
  return f;
}

template <class R>
Feature<R> face_feature(const V3<R>& p, const V3<R>& n) {
  Feature<R> f;
  f.kind = FeatureKind::face;
  f.p = p;
  f.c = n;
  return f;
}

/// A feature whose point does not depend on the direction.
template <class R>
FeaturePoint<R> fixed_point(const Feature<R>& f) {
  FeaturePoint<R> r;
  r.p = f.p;
  return r;
}

/// Normal of a triangle: the cross product of its two shorter edges.
template <class R>
V3<R> triangle_normal(const V3<R>& a, const V3<R>& b, const V3<R>& c) {
  const V3<R> ab = b - a, bc = c - b, ca = a - c;
  const R lab = ab.squaredNorm(), lbc = bc.squaredNorm(), lca = ca.squaredNorm();
  if (lab >= lbc && lab >= lca) return bc.cross(ca);
  return lbc >= lca ? ca.cross(ab) : ab.cross(bc);
}

/// Three support points without repetitions; points within `near` are the same.
template <class R>
struct DistinctPoints {
  std::array<V3<R>, 3> p;
  int size = 1;
  DistinctPoints(const std::array<V3<R>, 3>& from, R near) {
    p[0] = from[0];
    for (std::size_t k = 1; k < from.size(); ++k) {
      bool repeat = false;
      for (int i = 0; i < size; ++i)
        repeat |= (p[static_cast<std::size_t>(i)] - from[k]).template lpNorm<1>() <= near;
      if (!repeat) p[static_cast<std::size_t>(size++)] = from[k];
    }
  }
};

/// A quadratic form over the tangents of the unit sphere at a direction.
template <class R>
struct TangentForm {
  R xx = 0, xy = 0, yy = 0;
  void add(R k, R x, R y) {
    xx += k * x * x;
    xy += k * x * y;
    yy += k * y * y;
  }
  void add_all(R k) {
    xx += k;
    yy += k;
  }
  R least() const { return (xx + yy) / 2 - sqrt((xx - yy) * (xx - yy) / 4 + xy * xy); }
};

/// A unit direction m and two unit tangents x, y, orthogonal to it and to each other.
template <class R>
struct Tangents {
  V3<R> m, x, y;
};

/// Directions within θ of m, T = tan(θ/2): least cosine and largest sine.
template <class R>
struct Cap {
  R cosine, sine;
  explicit Cap(R t) : cosine((1 - t * t) / (1 + t * t)), sine(cosine > 0 ? 2 * t / (1 + t * t) : R(1)) {}
  /// Largest sine of the angle to an axis whose |cosine| to m is c.
  R most_sine(R c) const {
    const R s = sqrt(std::max<R>(0, 1 - c * c));
    return cosine > 0 && c * cosine - s * sine > 0 ? s * cosine + c * sine : R(1);
  }
};

/// The corners that lie at most `limit` below the support plane d·x = top. Lengths up to `tolerance` are 0.
template <class R>
struct FaceQuery {
  V3<R> d;  // unit
  R top, limit, tolerance;
};

/// Shows an edge to `out` if an end of it is within the limit: out.from(end, id), then out.to(other, id,
/// share). The other is within it too, with share 1, or the edge leaves it after this share of its length; of
/// two ends within it, the lower one comes second.
template <class R, class Out>
void edge_within(const FaceQuery<R>& at, const V3<R>& p, std::uint32_t p_id, const V3<R>& q,
                 std::uint32_t q_id, Out&& out) {
  const R p_below = at.top - at.d.dot(p), q_below = at.top - at.d.dot(q);
  if (p_below > q_below) return edge_within(at, q, q_id, p, p_id, out);
  if (p_below > at.limit) return;
  const R share = q_below <= at.limit ? R(1) : (at.limit - p_below) / (q_below - p_below);
  out.from(p, p_id);
  out.to(q, q_id, share);
}

/// How much of an edge of this length is within the limit, at most, from the support plane on: `slope` is the
/// cosine of its angle to the plane's normal, of either sign.
template <class R>
R reach_along(const FaceQuery<R>& at, R length, R slope) {
  return abs(slope) * length <= at.limit ? length : at.limit / abs(slope);
}

/// Corners that a face is expected to have at most. A face of vertices with more is listed by `add_many`.
inline constexpr int face_capacity = 72;

/// ±size, with the sign of `along`.
template <class R>
R toward(R size, R along) {
  if constexpr (std::is_floating_point_v<R>)
    return std::copysign(size, along);
  else
    return along < 0 ? -size : size;
}

template <class R>
R flat_length(const V3<R>& d) {
  return sqrt(d[0] * d[0] + d[1] * d[1]);
}

/// Distance of p from the axis through the origin along a (unit).
template <class R>
R off_axis(const V3<R>& p, const V3<R>& axis) {
  return p.cross(axis).norm();
}

/// The part of a core's interface that concerns curved parts, for a core that has none: its features are
/// corners, edges and faces, and each has a fixed support point.
template <class R>
struct Polyhedral {
  static constexpr bool is_polytope = true;
  M3<R> support_derivative(const V3<R>&) const { return M3<R>::Zero(); }
  FeaturePoint<R> locate(const Feature<R>& f, const V3<R>&) const { return fixed_point(f); }
  bool use_disc(Feature<R>&, const V3<R>&) const { return false; }
  void shorten(Feature<R>& f, bool high) const {
    f.p += (high ? f.hi : f.lo) * f.e;
    f.kind = FeatureKind::corner;
  }
};

}  // namespace touchstone::convex
