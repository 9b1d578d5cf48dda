// A convex body as core ⊕ ball for the search algorithms, and its support mapping, in its own frame.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <span>

#include "core/narrow/convex_core.h"
#include "core/narrow/fast/query.h"

namespace touchstone::narrow::fast {

template <class R>
struct Body {
  CoreKind kind = CoreKind::point;
  V3<R> size;                      // as in ConvexCore
  std::span<const Vec3> vertices;  // kind vertices
  R radius = 0;                    // of the ball
  R reach = 0;                     // of the core about the body's origin, rounded
  R extent = 0;                    // no more than the body's share of L
};

/// Index of the first vertex farthest along d.
inline std::size_t farthest_vertex(std::span<const Vec3> v, const V3<double>& d) {
  std::size_t best = 0, i = 0;
  double most = -std::numeric_limits<double>::infinity();
#if defined(__SSE2__)
  // Two vertices are three registers: x0 y0 | z0 x1 | y1 z1.
  const double* p = v.front().data();
  const __m128d d_xy = _mm_set_pd(d[1], d[0]), d_zx = _mm_set_pd(d[0], d[2]), d_yz = _mm_set_pd(d[2], d[1]);
  __m128d top = _mm_set1_pd(most), where = _mm_setzero_pd(), at = _mm_set_pd(1, 0);
  const __m128d two = _mm_set1_pd(2);
  for (; i + 2 <= v.size(); i += 2, p += 6) {
    const __m128d xy = _mm_mul_pd(_mm_loadu_pd(p), d_xy), zx = _mm_mul_pd(_mm_loadu_pd(p + 2), d_zx),
                  yz = _mm_mul_pd(_mm_loadu_pd(p + 4), d_yz);
    // (x0 + y0) + z0 | (x1 + y1) + z1
    const __m128d first = _mm_shuffle_pd(xy, zx, 2), second = _mm_shuffle_pd(xy, yz, 1);
    const __m128d dot = _mm_add_pd(_mm_add_pd(first, second), _mm_shuffle_pd(zx, yz, 2));
    const __m128d more = _mm_cmpgt_pd(dot, top);
    top = _mm_max_pd(dot, top);
    where = _mm_or_pd(_mm_and_pd(more, at), _mm_andnot_pd(more, where));
    at = _mm_add_pd(at, two);
  }
  if (i > 0) {
    double tops[2], wheres[2];
    _mm_storeu_pd(tops, top), _mm_storeu_pd(wheres, where);
    const int k = tops[1] > tops[0] || (tops[1] == tops[0] && wheres[1] < wheres[0]);
    most = tops[k], best = static_cast<std::size_t>(wheres[k]);
  }
#endif
  for (; i < v.size(); ++i)
    if (const double dot = (v[i][0] * d[0] + v[i][1] * d[1]) + v[i][2] * d[2]; dot > most)
      most = dot, best = i;
  return best;
}

/// Square of the largest distance from the origin.
inline double largest_norm_sq(std::span<const Vec3> v) {
  double most = 0;
  std::size_t i = 0;
#if defined(__SSE2__)
  const double* p = v.front().data();
  __m128d top = _mm_setzero_pd();
  for (; i + 2 <= v.size(); i += 2, p += 6) {
    const __m128d l0 = _mm_loadu_pd(p), l1 = _mm_loadu_pd(p + 2), l2 = _mm_loadu_pd(p + 4);
    const __m128d xy = _mm_mul_pd(l0, l0), zx = _mm_mul_pd(l1, l1), yz = _mm_mul_pd(l2, l2);
    const __m128d sum = _mm_add_pd(_mm_shuffle_pd(xy, zx, 2), _mm_shuffle_pd(xy, yz, 1));
    top = _mm_max_pd(top, _mm_add_pd(sum, _mm_shuffle_pd(zx, yz, 2)));
  }
  double tops[2];
  _mm_storeu_pd(tops, top);
  most = std::max(tops[0], tops[1]);
#endif
  for (; i < v.size(); ++i) most = std::max(most, v[i].squaredNorm());
  return most;
}

/// farthest_vertex in float, for vertices rounded to float.
inline std::size_t farthest_vertex(std::span<const Vec3> v, const V3<float>& d) {
  std::size_t best = 0;
  float most = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < v.size(); ++i) {
    const float dot = (static_cast<float>(v[i][0]) * d[0] + static_cast<float>(v[i][1]) * d[1]) +
                      static_cast<float>(v[i][2]) * d[2];
    if (dot > most) most = dot, best = i;
  }
  return best;
}

/// A core point farthest along d; d not zero.
template <class R>
V3<R> support_local(const Body<R>& c, const V3<R>& d) {
  const V3<R>& s = c.size;
  switch (c.kind) {
    case CoreKind::point:
      return V3<R>::Zero();
    case CoreKind::segment:
      return {0, 0, std::copysign(s[2], d[2])};
    case CoreKind::box:
      return {std::copysign(s[0], d[0]), std::copysign(s[1], d[1]), std::copysign(s[2], d[2])};
    case CoreKind::cylinder: {
      const R n = std::sqrt(d[0] * d[0] + d[1] * d[1]), k = n > 0 ? s[0] / n : 0;
      return {n > 0 ? d[0] * k : s[0], d[1] * k, std::copysign(s[2], d[2])};
    }
    case CoreKind::cone: {
      const R n = std::sqrt(d[0] * d[0] + d[1] * d[1]), k = n > 0 ? s[0] / n : 0;
      if (d[2] * 2 * s[2] > s[0] * n) return {0, 0, s[2]};
      return {n > 0 ? d[0] * k : s[0], d[1] * k, -s[2]};
    }
    case CoreKind::ellipsoid: {
      const V3<R> e = s.cwiseProduct(d);
      const R n = e.norm();
      return n > 0 ? V3<R>(s.cwiseProduct(e) * (1 / n)) : V3<R>(s[0], 0, 0);
    }
    case CoreKind::vertices:
      return c.vertices[farthest_vertex(c.vertices, d)].template cast<R>();
  }
  return V3<R>::Zero();
}

template <class R>
bool is_curved(const Body<R>& c) {
  return c.kind == CoreKind::cylinder || c.kind == CoreKind::cone || c.kind == CoreKind::ellipsoid;
}

/// Derivative of the support point along a unit d, where it has one: zero for corners and edges.
template <class R>
M3<R> support_derivative(const Body<R>& c, const V3<R>& d) {
  M3<R> m = M3<R>::Zero();
  if (c.kind == CoreKind::ellipsoid) {
    // S²/h − p pᵀ/h with p = S² d/h.
    const V3<R> e = c.size.cwiseProduct(d);
    const R h = e.norm();
    const V3<R> p = c.size.cwiseProduct(e) / h;
    m.diagonal() = c.size.cwiseProduct(c.size) / h;
    m -= p * p.transpose() / h;
  } else if (c.kind == CoreKind::cylinder ||
             (c.kind == CoreKind::cone &&
              !(d[2] * 2 * c.size[2] > c.size[0] * std::sqrt(d[0] * d[0] + d[1] * d[1])))) {
    // r/ρ along the rim's tangent.
    const R rho = std::sqrt(d[0] * d[0] + d[1] * d[1]);
    if (!(rho > 0)) return m;
    const R x = -d[1] / rho, y = d[0] / rho, k = c.size[0] / rho;
    m(0, 0) = k * x * x, m(0, 1) = m(1, 0) = k * x * y, m(1, 1) = k * y * y;
  }
  return m;
}

/// Precondition: bounded and convex. The span views the shape.
template <class R>
Body<R> make_body(const Shape& shape) {
  Body<R> c;
  const auto round = [&](CoreKind kind, double r, double h) {
    c.kind = kind, c.size = V3<R>(static_cast<R>(r), static_cast<R>(r), static_cast<R>(h));
    c.reach = c.size[0] + c.size[2], c.extent = std::max(c.size[0], c.size[2]);
  };
  switch (kind_of(shape)) {
    case ShapeKind::sphere:
      c.radius = static_cast<R>(std::get_if<Sphere>(&shape)->radius), c.extent = c.radius;
      break;
    case ShapeKind::capsule: {
      const auto& s = *std::get_if<Capsule>(&shape);
      round(CoreKind::segment, 0, s.half_height), c.radius = static_cast<R>(s.radius);
      c.extent = c.size[2] + c.radius;
      break;
    }
    case ShapeKind::cylinder:
      round(CoreKind::cylinder, std::get_if<Cylinder>(&shape)->radius,
            std::get_if<Cylinder>(&shape)->half_height);
      break;
    case ShapeKind::cone:
      round(CoreKind::cone, std::get_if<Cone>(&shape)->radius, std::get_if<Cone>(&shape)->half_height);
      break;
    case ShapeKind::box:
      c.kind = CoreKind::box, c.size = std::get_if<Box>(&shape)->half_extents.cast<R>();
      c.reach = c.size.norm(), c.extent = c.size.maxCoeff();
      break;
    case ShapeKind::ellipsoid:
      c.kind = CoreKind::ellipsoid, c.size = std::get_if<Ellipsoid>(&shape)->semi_axes.cast<R>();
      c.reach = c.extent = c.size.maxCoeff();
      break;
    default: {
      c.kind = CoreKind::vertices, c.vertices = std::get_if<Hull>(&shape)->vertices;
      c.reach = c.extent = static_cast<R>(std::sqrt(largest_norm_sq(c.vertices)));
    }
  }
  return c;
}

}  // namespace touchstone::narrow::fast
