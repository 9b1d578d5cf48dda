// Triangle mesh: the union of its closed triangles, a closed set and a surface without an inside. Bodies with
// a mesh are static.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/field.h"

namespace touchstone {

struct TriangleMesh {
  std::vector<Vec3> vertices;                 // n×3, body frame
  std::vector<std::array<int, 3>> triangles;  // m×3 indices into vertices
  static constexpr std::string_view type = "mesh";
  static constexpr auto fields() {
    return std::tuple{Field{"vertices", &TriangleMesh::vertices, Domain::any},
                      Field{"triangles", &TriangleMesh::triangles, Domain::any}};
  }

  double bounding_radius() const { return farthest(vertices); }
  double extent() const { return largest_half_extent(vertices); }
  template <class T>
  Interval<T> extent_along(const V3<T>& d) const {
    return extent_of<T>(vertices, d);
  }
  Wide coordinate_sum() const { return largest_coordinate_sum(vertices); }
  InnerRadii inner_radii() const {
    double most = 0;
    for (const Vec3& v : vertices) most = std::max(most, v.norm());
    return {0, -most};
  }
  bool operator==(const TriangleMesh& o) const { return vertices == o.vertices && triangles == o.triangles; }
};

}  // namespace touchstone
