// Convex hull of points: the set is conv(vertices), exactly. Points that are not extreme, duplicates, and
// flat sets (a point, a segment, a polygon) are legitimate. Faces are a convenience for engines that want
// them.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "core/math/pose.h"
#include "core/shape/field.h"

namespace touchstone {

struct Hull {
  std::vector<Vec3> vertices;  // n×3, n >= 1, body frame
  /// Triangles (vertex indices, counter-clockwise from outside) from qhull; empty when the set is flat or so
  /// thin that qhull finds no full-dimensional simplex. Derived: not compared, not hashed.
  std::vector<std::array<int, 3>> faces;
  /// Affine dimension of the vertices, 0 to 3, decided exactly on the doubles. Derived.
  int dimension = 0;
  static constexpr std::string_view type = "hull";
  static constexpr auto fields() { return std::tuple{Field{"vertices", &Hull::vertices, Domain::any}}; }
  bool operator==(const Hull& o) const { return vertices == o.vertices; }
};

/// Computes faces and dimension. Throws InputError when there are no vertices or a coordinate is not finite.
Hull make_hull(std::vector<Vec3> vertices);

inline Vec3 support(const Hull& h, const Vec3& d) {
  const Vec3* best = &h.vertices.front();
  double best_dot = best->dot(d);
  for (const Vec3& v : h.vertices) {
    const double dot = v.dot(d);
    if (dot > best_dot) {
      best_dot = dot;
      best = &v;
    }
  }
  return *best;
}

}  // namespace touchstone
