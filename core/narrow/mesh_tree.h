// Which triangles of a mesh may be near a ball: a binary tree of axis-aligned boxes in the mesh's own frame,
// split at the median of the longest axis of the centroids (Ericson 2005, §6.2). Built once a mesh and given
// to queries by PlacedShape::tree; a query without one looks at every triangle's box. The tree only leaves
// out: the answer is that of all triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "core/shape/triangle_mesh.h"

namespace touchstone {

struct MeshTree {
  /// Exact box of the triangles below. Leaf: count > 0, triangles order[first…]; else children first, first
  /// + 1.
  struct Node {
    Vec3 lo, hi;
    std::int32_t first, count;
  };
  std::vector<Node> nodes;  // root first; none: no triangles
  std::vector<std::int32_t> order;
};

/// The same mesh, not changed since, goes with the tree.
MeshTree build_mesh_tree(const TriangleMesh& mesh);

/// A lower bound of the square of the distance from p to a box, but for a few roundings relative to itself
/// and to the coordinates of the two.
inline double box_distance_sq(const Vec3& p, const Vec3& lo, const Vec3& hi) {
  return (p.cwiseMax(lo).cwiseMin(hi) - p).squaredNorm();
}

}  // namespace touchstone
