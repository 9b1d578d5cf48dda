// A convex body in a frame.
#pragma once

#include "core/narrow/collider.h"

namespace touchstone::narrow {

template <class R>
struct ConvexCore : ConvexBody<R> {
  Frame<R> frame;
};

inline ConvexCore<Wide> vertices_core(std::span<const Vec3> vertices, const WideFrame& frame) {
  return {body_of_vertices<Wide>(vertices), frame};
}

/// Precondition: a bounded convex shape.
inline ConvexCore<Wide> make_core(const ShapeRef& shape, const WideFrame& frame) {
  return {shape.body<Wide>(), frame};
}

/// A core point farthest along d, in the outer coordinates of the frame.
template <class R>
V3<R> support(const ConvexCore<R>& c, const V3<R>& d) {
  return c.frame.rotation * support_local<R>(c, c.frame.rotation.transpose() * d) + c.frame.translation;
}

/// h(n) of core ⊕ ball for a unit vector n.
template <class R>
R support_value(const ConvexCore<R>& c, const V3<R>& n) {
  return n.dot(support(c, n)) + c.radius;
}

}  // namespace touchstone::narrow
