// A convex body or a mesh against a triangle mesh, triangle by triangle. A mesh is a surface: the distance is
// that to the nearest triangle. When triangles are hit, gap, normal and depth are those of the deepest one
// (the least motion that frees the body from that triangle, not from the whole mesh).
#pragma once

#include <vector>

#include "core/narrow/convex_core.h"
#include "core/narrow/result.h"

namespace touchstone::narrow {

/// Vertices that belong to a triangle; unused ones are omitted.
std::vector<Vec3> used_vertices(const TriangleMesh& m);

/// Triangles whose boxes are within `bound` of the ball about `centre` (mesh frame), nearest first, each with
/// that lower bound of its distance to the ball. Rounded conservatively.
struct TriangleBound {
  Wide distance;
  std::size_t triangle;
};
std::vector<TriangleBound> triangles_near(const TriangleMesh& m, const WideVec& centre, Wide radius,
                                          Wide bound);

std::array<Vec3, 3> corners(const TriangleMesh& m, std::size_t triangle);

Separation core_mesh(const ConvexCore<Wide>& a, const TriangleMesh& mesh, const WideFrame& frame);

/// Two meshes: the least gap of their pairs of triangles.
Separation mesh_mesh(const ShapeRef& a, const WideFrame& frame_a, const ShapeRef& b,
                     const WideFrame& frame_b);

}  // namespace touchstone::narrow
