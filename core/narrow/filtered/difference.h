// The Minkowski difference B − A of two placed cores, represented by its support points.
#pragma once

#include "core/narrow/filtered/query.h"
#include "core/narrow/simplex.h"
#include "core/shape/convex_body.h"

namespace touchstone::narrow::filtered {

template <class R>
struct Difference {
  const ConvexBody<R>&a, &b;
  const Relative<R>& at;
  /// A point of B − A farthest along d.
  Vertex<R> support(const V3<R>& d) const {
    Vertex<R> s;
    s.a = support_local<R>(a, -d);
    s.w = at.b_to_a * support_local<R>(b, at.b_to_a.transpose() * d) + at.offset - s.a;
    return s;
  }
};

}  // namespace touchstone::narrow::filtered
