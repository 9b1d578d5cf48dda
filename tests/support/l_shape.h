// A solid that is not convex.
#pragma once

#include "core/shape/triangle_mesh.h"

namespace touchstone::test {

/// [0,3]×[0,3]×[-1,1] without (1,3]×(1,3]×[-1,1].
inline TriangleMesh l_shape() {
  const double base[][2] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  TriangleMesh m;
  for (const double z : {-1.0, 1.0})
    for (const auto& p : base) m.vertices.push_back({p[0], p[1], z});
  for (int i = 1; i + 1 < 6; ++i) {
    m.triangles.push_back({6, 6 + i, 7 + i});
    m.triangles.push_back({0, i + 1, i});
  }
  for (int i = 0; i < 6; ++i) {
    m.triangles.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6});
    m.triangles.push_back({i, 6 + (i + 1) % 6, 6 + i});
  }
  return m;
}

}  // namespace touchstone::test
