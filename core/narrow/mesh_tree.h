// Finds the triangles of a mesh that may be near a ball: a binary tree of axis-aligned boxes in the mesh's
// own frame, split at the median of the centroids' longest axis (Ericson 2005, §6.2). It belongs to
// the mesh's collider; a query without one tests every triangle's box. The tree only prunes: the answer is
// that of all triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "core/shape/triangle_mesh.h"

namespace touchstone {

/// A box along axes of its own: the columns of `axes`, orthonormal within rounding. It contains its points
/// within a few roundings of their coordinates.
struct OrientedBox {
  Mat3 axes;
  Vec3 centre, half;
};

struct MeshTree {
  /// Exact box of the triangles below. Leaf: count > 0, triangles order[first…]; otherwise the children are
  /// nodes first and first + 1.
  struct Node {
    Vec3 lo, hi;
    std::int32_t first, count;
  };
  std::vector<Node> nodes;  // root first; empty: no triangles
  /// Of each node, for pairs of meshes: curved surfaces near each other are told apart by a third of the
  /// pairs of boxes that it takes with `lo` and `hi`, in half the time (tests/bench/meshes.cpp).
  std::vector<OrientedBox> oriented;
  std::vector<std::int32_t> order;
};

/// The tree is valid for this mesh only, and only while the mesh is unchanged.
MeshTree build_mesh_tree(const TriangleMesh& mesh);

/// Squared distance from p to a box; a lower bound up to a few roundings relative to itself and to the
/// coordinates.
inline double box_distance_sq(const Vec3& p, const Vec3& lo, const Vec3& hi) {
  return (p.cwiseMax(lo).cwiseMin(hi) - p).squaredNorm();
}

}  // namespace touchstone
