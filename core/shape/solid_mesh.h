// Solid mesh: the closed region inside a closed triangle mesh, its triangles included. Bodies with a solid
// mesh are static.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/shape/triangle_mesh.h"

namespace touchstone {

struct SolidMesh : TriangleMesh {
  static constexpr std::string_view type = "solid_mesh";
  SolidMesh() = default;
  explicit SolidMesh(TriangleMesh surface) : TriangleMesh(std::move(surface)) {}
};

/// Why a mesh is not the surface of a solid, and where: "triangles[12]", "vertices[3]".
struct SolidFlaw {
  std::string place, reason;
};

/// Exact. A mesh is the surface of a solid if every vertex belongs to a triangle, no triangle is without
/// area, each edge belongs to two triangles, which run along it in opposite directions, no two triangles meet
/// except in a common edge or vertex, and triangles are counter-clockwise seen from outside, those of a
/// cavity from within it. Vertices with equal coordinates count as one. nullopt: it is. Precondition: indices
/// in range, finite coordinates.
std::optional<SolidFlaw> flaw_of_solid(const TriangleMesh& surface);

/// How often the surface of a valid solid winds around a point (mesh frame): 1 inside, 0 outside. Exact; for
/// a point on the surface, either.
int winding_number(const TriangleMesh& surface, const Vec3& point);

/// Whether the solid inside a valid surface is convex: then it is the hull of its vertices. Exact.
bool is_convex_solid(const TriangleMesh& surface);

/// A point of each part of any mesh that is connected by vertices: the middle of its largest triangle.
std::vector<Vec3> points_of_parts(const TriangleMesh& mesh);

/// Of each connected part of a valid solid's surface, a point inside the solid near which the surface is
/// not: behind the middle of the part's largest triangle, halfway to the next.
std::vector<Vec3> inner_points(const TriangleMesh& surface);

}  // namespace touchstone
