// Triangle mesh: the union of its closed triangles, a closed set and a surface without an inside. Bodies with
// a mesh are static.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "core/math/pose.h"
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
  bool operator==(const TriangleMesh& o) const { return vertices == o.vertices && triangles == o.triangles; }
};

}  // namespace touchstone
