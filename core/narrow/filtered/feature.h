// The feature of a body along a direction: a corner, an edge (or the straight line of a round side), a flat
// face, or a round part. A direction held by an edge stays on a circle of directions, one held by a face is
// fixed; along round parts the support point moves smoothly.
#pragma once

#include "core/narrow/filtered/difference.h"

namespace touchstone::narrow::filtered {

enum class Shown { corner, edge, face, round };

/// A feature of one body, in its own frame. Members not listed for a kind are unset.
template <class R>
struct Feature {
  Shown shown = Shown::corner;
  /// Corner; edge: its point at parameter 0 (for a round side, of its axis; for a cone, the apex).
  V3<R> p = V3<R>::Zero();
  V3<R> e = V3<R>::Zero();      // edge: unit; cones: set by place()
  R lo = 0, hi = 0;             // edge: parameters of its ends
  V3<R> c = V3<R>::Zero();      // edge: its directions d satisfy d·c = s; face: outward normal
  R s = 0, k = 1;               // k = √(1 − s²), stored because s close to 1 loses it
  std::array<V3<R>, 3> corner;  // face of vertices
};

/// Support point and its derivative, H = k t tᵀ + (diagonal of squares − p pᵀ)/h, which the Newton step
/// needs.
template <class R>
struct Placed {
  V3<R> p;                  // on the feature
  V3<R> t = V3<R>::Zero();  // tangent of a rim
  R k = 0;                  // its radius over the sine of the axis
  R h = 0;                  // ellipsoids: d·p
};

namespace detail {

/// Of a rim's radius: nearer to the axis than this, the disc is touched and not the rim. Only a guess.
template <class R>
inline constexpr R disc_share = R(0.9);

template <class R>
R flat_length(const V3<R>& d) {
  return std::sqrt(d[0] * d[0] + d[1] * d[1]);
}

template <class R>
Feature<R> edge_feature(const V3<R>& p, const V3<R>& e, R lo, R hi) {
  Feature<R> f;
  f.shown = Shown::edge;
  f.p = p;
  f.e = f.c = e;
  f.lo = lo;
  f.hi = hi;
  return f;
}

template <class R>
Feature<R> face_feature(const V3<R>& p, const V3<R>& n) {
  Feature<R> f;
  f.shown = Shown::face;
  f.p = p;
  f.c = n;
  return f;
}

template <class R>
Feature<R> corner_feature(const V3<R>& p) {
  Feature<R> f;
  f.p = p;
  return f;
}

/// Box and vertices: decided by the number of distinct corners among three support points.
template <class R>
Feature<R> polytope_feature(const Body<R>& b, const std::array<V3<R>, 3>& q, const V3<R>& d, R near) {
  std::array<V3<R>, 3> k;
  int n = 0;
  for (const V3<R>& p : q) {
    bool repeat = false;
    for (int i = 0; i < n; ++i) repeat |= (k[static_cast<std::size_t>(i)] - p).template lpNorm<1>() <= near;
    if (!repeat) k[static_cast<std::size_t>(n++)] = p;
  }
  if (n == 1) return corner_feature<R>(k[0]);
  if (b.kind == CoreKind::vertices) {
    if (n == 2) {
      const R length = (k[1] - k[0]).norm();
      return edge_feature<R>(k[0], (k[1] - k[0]) / length, 0, length);
    }
    V3<R> m = triangle_normal(k[0], k[1], k[2]).normalized();
    if (m.dot(d) < 0) m = -m;
    Feature<R> f = face_feature<R>(k[0], m);
    f.corner = k;
    return f;
  }
  // For a box: the coordinates in which the corners differ.
  int axes = 0, axis = 0, same = 0;
  for (int i = 0; i < 3; ++i) {
    const bool differ = k[0][i] != k[1][i] || (n == 3 && k[0][i] != k[2][i]);
    if (differ) {
      ++axes;
      axis = i;
    } else {
      same = i;
    }
  }
  if (axes == 1) {
    V3<R> p = k[0];
    p[axis] = 0;
    return edge_feature<R>(p, V3<R>::Unit(axis), -b.size[axis], b.size[axis]);
  }
  if (axes == 2) return face_feature<R>(k[0], V3<R>::Unit(same) * (k[0][same] < 0 ? R(-1) : R(1)));
  Feature<R> f = corner_feature<R>(support_local<R>(b, d));
  return f;
}

}  // namespace detail

/// The feature suggested by three support points of a facet with normal d. `foot`: the body's point of the
/// origin's foot. Points within `near` are the same. This is a guess that is verified afterwards.
template <class R>
Feature<R> suggested_feature(const Body<R>& b, const std::array<V3<R>, 3>& q, const V3<R>& foot,
                             const V3<R>& d, R near) {
  using namespace detail;
  const V3<R>& s = b.size;
  const R most = std::max(q[0][2], std::max(q[1][2], q[2][2])),
          least = std::min(q[0][2], std::min(q[1][2], q[2][2]));
  // Support points on one rim with their mean well inside it: the disc. Where the rim itself is touched they
  // are close to each other, and their mean is close to the rim.
  const auto rim_or_disc = [&] {
    if (flat_length<R>(foot) < disc_share<R> * s[0])
      return face_feature<R>(q[0], V3<R>(0, 0, q[0][2] < 0 ? R(-1) : R(1)));
    Feature<R> f;
    f.shown = Shown::round;
    f.p = V3<R>(0, 0, q[0][2]);
    return f;
  };
  switch (b.kind) {
    case CoreKind::point:
      return corner_feature<R>(V3<R>::Zero());
    case CoreKind::segment:
    case CoreKind::cylinder:
      if (most > least) return edge_feature<R>(V3<R>::Zero(), V3<R>::UnitZ(), -s[2], s[2]);
      return b.kind == CoreKind::segment ? corner_feature<R>(q[0]) : rim_or_disc();
    case CoreKind::cone: {
      if (most > least) {
        const R length = std::sqrt(s[0] * s[0] + 4 * s[2] * s[2]);
        Feature<R> f = edge_feature<R>(V3<R>(0, 0, s[2]), V3<R>::UnitZ(), 0, length);
        f.s = s[0] / length;
        f.k = 2 * s[2] / length;
        return f;
      }
      return least > 0 ? corner_feature<R>(q[0]) : rim_or_disc();
    }
    case CoreKind::ellipsoid: {
      Feature<R> f;
      f.shown = Shown::round;
      return f;
    }
    case CoreKind::box:
    case CoreKind::vertices:
      break;
  }
  return polytope_feature(b, q, d, near);
}

/// The feature's support point along a unit d; d lies on the feature's circle if it has one.
template <class R>
Placed<R> place(const Body<R>& b, Feature<R>& f, const V3<R>& d) {
  Placed<R> r;
  const V3<R>& s = b.size;
  r.p = f.p;
  if (b.kind == CoreKind::ellipsoid) {
    const V3<R> e = s.cwiseProduct(d);
    r.h = e.norm();
    r.p = s.cwiseProduct(e) / r.h;
    return r;
  }
  const bool side = f.shown == Shown::edge, round = f.shown == Shown::round;
  if (!(b.kind == CoreKind::cylinder && (side || round)) && !(b.kind == CoreKind::cone && (side || round)))
    return r;
  const R rho = detail::flat_length(d);
  const V3<R> out = rho > 0 ? V3<R>(d[0] / rho, d[1] / rho, 0) : V3<R>(V3<R>::UnitX());
  if (b.kind == CoreKind::cone && side) {
    f.e = V3<R>(s[0] * out[0], s[0] * out[1], -2 * s[2]) / f.hi;
    return r;
  }
  r.p += s[0] * out;
  r.t = V3<R>(-out[1], out[0], 0);
  r.k = rho > 0 ? s[0] / rho : 0;
  return r;
}

/// How far a face extends around its point q, in its plane: zero or negative when q is not on it.
template <class R>
R face_margin(const Body<R>& b, const Feature<R>& f, const V3<R>& q) {
  if (b.kind == CoreKind::cylinder || b.kind == CoreKind::cone) return b.size[0] - detail::flat_length(q);
  R least = std::numeric_limits<R>::infinity();
  if (b.kind == CoreKind::box) {
    for (int k = 0; k < 3; ++k)
      if (f.c[k] == 0) least = std::min(least, b.size[k] - std::abs(q[k]));
    return least;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const V3<R>&x = f.corner[k], &y = f.corner[(k + 1) % 3], &z = f.corner[(k + 2) % 3];
    V3<R> in = f.c.cross(y - x).normalized();
    if (in.dot(z - x) < 0) in = -in;
    least = std::min(least, in.dot(q - x));
  }
  return least;
}

}  // namespace touchstone::narrow::filtered
