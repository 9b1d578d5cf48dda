// A convex body as core ⊕ ball for the search algorithms, and its support mapping, in its own frame.
#pragma once

#include <span>

#include "core/narrow/convex_core.h"
#include "core/narrow/filtered/query.h"
#include "core/narrow/filtered/vertex_climb.h"
#include "core/narrow/filtered/vertex_scan.h"

namespace touchstone::narrow::filtered {

template <class R>
struct Body {
  CoreKind kind = CoreKind::point;
  V3<R> size;                        // as in ConvexCore
  std::span<const Vec3> vertices;    // kind vertices
  const HullGraph* graph = nullptr;  // of `vertices`, or null
  R radius = 0;                      // of the ball
  R reach = 0;                       // of the core about the body's origin, rounded
  R extent = 0;                      // at most the body's share of L
  R unit = 1;                        // power of two; scales `vertices` to the core's vertices
};

/// A core point farthest along d; d is not zero.
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
      return c.vertices[c.graph ? farthest_vertex(*c.graph, c.vertices, d) : farthest_vertex(c.vertices, d)]
                 .template cast<R>() *
             c.unit;
  }
  return V3<R>::Zero();
}

template <class R>
bool is_curved(const Body<R>& c) {
  return c.kind == CoreKind::cylinder || c.kind == CoreKind::cone || c.kind == CoreKind::ellipsoid;
}

/// Derivative of the support point with respect to a unit direction d, where it exists: zero for corners and
/// edges.
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
    m(0, 0) = k * x * x;
    m(0, 1) = m(1, 0) = k * x * y;
    m(1, 1) = k * y * y;
  }
  return m;
}

/// Precondition: bounded and convex. The body refers to the shape's vertices; `graph`, if any, belongs to
/// that shape.
template <class R>
Body<R> make_body(const Shape& shape, const HullGraph* graph = nullptr) {
  Body<R> c;
  const auto round = [&](CoreKind kind, double r, double h) {
    c.kind = kind;
    c.size = V3<R>(static_cast<R>(r), static_cast<R>(r), static_cast<R>(h));
    c.reach = c.size[0] + c.size[2];
    c.extent = std::max(c.size[0], c.size[2]);
  };
  const auto box = [&](const Vec3& half_extents) {
    c.kind = CoreKind::box;
    c.size = half_extents.cast<R>();
    c.reach = c.size.norm();
    c.extent = c.size.maxCoeff();
  };
  switch (kind_of(shape)) {
    case ShapeKind::sphere:
      c.radius = static_cast<R>(std::get_if<Sphere>(&shape)->radius);
      c.extent = c.radius;
      break;
    case ShapeKind::capsule: {
      const auto& s = *std::get_if<Capsule>(&shape);
      round(CoreKind::segment, 0, s.half_height);
      c.radius = static_cast<R>(s.radius);
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
      box(std::get_if<Box>(&shape)->half_extents);
      break;
    case ShapeKind::rounded_box:
      box(std::get_if<RoundedBox>(&shape)->half_extents);
      c.radius = static_cast<R>(std::get_if<RoundedBox>(&shape)->radius);
      c.extent += c.radius;
      break;
    case ShapeKind::ellipsoid:
      c.kind = CoreKind::ellipsoid;
      c.size = std::get_if<Ellipsoid>(&shape)->semi_axes.cast<R>();
      c.reach = c.extent = c.size.maxCoeff();
      break;
    default: {
      c.kind = CoreKind::vertices;
      c.vertices = std::get_if<Hull>(&shape)->vertices;
      if (graph && *graph) c.graph = graph;
      c.reach = c.extent = static_cast<R>(c.graph ? c.graph->reach : std::sqrt(largest_norm_sq(c.vertices)));
    }
  }
  return c;
}

}  // namespace touchstone::narrow::filtered
