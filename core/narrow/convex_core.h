// A placed convex shape as core ⊕ ball: sphere = point ⊕ ball, capsule = segment ⊕ ball, rounded box = box ⊕
// ball; every other shape is its own core with radius 0. GJK and EPA see only the cores, so a shallow contact
// of rounded shapes is a distance between cores, which is well conditioned, instead of a depth.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/math/wide.h"
#include "core/shape/shape.h"

namespace touchstone::narrow {

enum class CoreKind { point, segment, box, cylinder, cone, ellipsoid, vertices };

template <class R>
struct ConvexCore {
  CoreKind kind = CoreKind::point;
  V3<R> size = V3<R>::Zero();      // half extents, semi-axes, or (radius, -, half height); segment: z only
  std::span<const Vec3> vertices;  // kind vertices; the shape (or triangle) outlives the core
  R radius = 0;                    // of the ball
  R reach = 0;                     // bound on the core's distance from the frame's origin
  Frame<R> frame;
};

template <class R>
bool is_polytope(const ConvexCore<R>& c) {
  return c.kind == CoreKind::point || c.kind == CoreKind::segment || c.kind == CoreKind::box ||
         c.kind == CoreKind::vertices;
}

/// A core point farthest along d, in the body frame; d of any length, including zero.
template <class R>
V3<R> support_local(const ConvexCore<R>& c, const V3<R>& d) {
  const V3<R>& s = c.size;
  const auto toward = [](R size, R along) { return along < 0 ? -size : size; };
  const auto rim = [&] {
    const R n = sqrt(d.x() * d.x() + d.y() * d.y());
    return n > 0 ? V3<R>(d.x() / n * s.x(), d.y() / n * s.x(), 0) : V3<R>(s.x(), 0, 0);
  };
  switch (c.kind) {
    case CoreKind::point:
      return V3<R>::Zero();
    case CoreKind::segment:
      return {0, 0, toward(s.z(), d.z())};
    case CoreKind::box:
      return {toward(s.x(), d.x()), toward(s.y(), d.y()), toward(s.z(), d.z())};
    case CoreKind::cylinder:
      return rim() + V3<R>(0, 0, toward(s.z(), d.z()));
    case CoreKind::cone:
      if (d.z() * 2 * s.z() > s.x() * sqrt(d.x() * d.x() + d.y() * d.y())) return {0, 0, s.z()};
      return rim() - V3<R>(0, 0, s.z());
    case CoreKind::ellipsoid: {
      const V3<R> e = s.cwiseProduct(d);
      const R n = e.norm();
      return n > 0 ? V3<R>(s.cwiseProduct(e) / n) : V3<R>(s.x(), 0, 0);
    }
    case CoreKind::vertices: {
      const Vec3* best = &c.vertices.front();
      R best_dot = d.dot(best->template cast<R>());
      for (const Vec3& v : c.vertices.subspan(1)) {
        const R dot = d.x() * R(v.x()) + d.y() * R(v.y()) + d.z() * R(v.z());
        if (dot > best_dot) {
          best_dot = dot;
          best = &v;
        }
      }
      return best->template cast<R>();
    }
  }
  return V3<R>::Zero();
}

/// The same in the outer coordinates of the frame.
template <class R>
V3<R> support(const ConvexCore<R>& c, const V3<R>& d) {
  return c.frame.rotation * support_local<R>(c, c.frame.rotation.transpose() * d) + c.frame.translation;
}

/// h(n) of core ⊕ ball for a unit vector n.
template <class R>
R support_value(const ConvexCore<R>& c, const V3<R>& n) {
  return n.dot(support(c, n)) + c.radius;
}

inline ConvexCore<Wide> vertices_core(std::span<const Vec3> vertices, const WideFrame& frame) {
  ConvexCore<Wide> c{.kind = CoreKind::vertices, .vertices = vertices, .frame = frame};
  for (const Vec3& v : vertices) c.reach = std::max(c.reach, v.cast<Wide>().norm());
  return c;
}

/// Precondition: a bounded convex shape (neither half-space nor mesh).
inline ConvexCore<Wide> make_core(const Shape& shape, const WideFrame& frame) {
  ConvexCore<Wide> c;
  c.frame = frame;
  const auto round = [&](CoreKind kind, Wide r, Wide h) {
    c.kind = kind;
    c.size = WideVec(r, r, h);
    c.reach = sqrt(r * r + h * h);
  };
  if (const auto* s = std::get_if<Sphere>(&shape)) c.radius = s->radius;
  if (const auto* s = std::get_if<Capsule>(&shape)) {
    round(CoreKind::segment, 0, s->half_height);
    c.radius = s->radius;
  }
  if (const auto* s = std::get_if<Cylinder>(&shape)) round(CoreKind::cylinder, s->radius, s->half_height);
  if (const auto* s = std::get_if<Cone>(&shape)) round(CoreKind::cone, s->radius, s->half_height);
  if (const auto* s = std::get_if<Hull>(&shape)) return vertices_core(s->vertices, frame);
  const auto box = [&](const Vec3& half_extents) {
    c.kind = CoreKind::box;
    c.size = half_extents.cast<Wide>();
    c.reach = c.size.norm();
  };
  if (const auto* s = std::get_if<Box>(&shape)) box(s->half_extents);
  if (const auto* s = std::get_if<RoundedBox>(&shape)) {
    box(s->half_extents);
    c.radius = s->radius;
  }
  if (const auto* s = std::get_if<Ellipsoid>(&shape)) {
    c.kind = CoreKind::ellipsoid;
    c.size = s->semi_axes.cast<Wide>();
    c.reach = c.size.maxCoeff();
  }
  return c;
}

}  // namespace touchstone::narrow
