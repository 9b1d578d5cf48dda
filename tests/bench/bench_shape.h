// Shapes for the pair benchmarks.
#pragma once

#include "tests/support/plain_shape.h"

namespace touchstone::bench {

/// About unit size; a hull's vertices lie on an ellipsoid, so that all of them are extreme.
inline Shape make_shape(Rng& rng, ShapeKind kind, int vertices) {
  return test::plain_shape(rng, kind, [vertices](Rng& r, auto&& size) {
    const Vec3 axes(size(), size(), size());
    std::vector<Vec3> v;
    for (int i = 0; i < vertices; ++i) v.push_back(axes.cwiseProduct(r.unit_vector()));
    return make_hull(std::move(v));
  });
}

}  // namespace touchstone::bench
