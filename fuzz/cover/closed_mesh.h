// Distances from a closed mesh and its inside, in doubles.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/math/aabb.h"
#include "core/shape/triangle_mesh.h"

namespace touchstone::fuzz {

class ClosedMesh {
 public:
  /// Refers to the mesh.
  explicit ClosedMesh(const TriangleMesh& mesh);

  struct Nearest {
    double distance = 0;  // from the surface
    int triangle = 0;
  };
  Nearest nearest(const Vec3& p) const;
  double distance(const Vec3& p, int triangle) const;

  /// By the sum of the solid angles of all triangles (van Oosterom and Strackee 1983), 4π times how often the
  /// surface winds around the point. Meaningful for points that are not on the surface within rounding.
  bool is_inside(const Vec3& p) const;

  /// If no triangle reaches into the tetrahedron by more than `slack` along some axis that separates them,
  /// the least width of the tetrahedron along these axes (infinite if no triangle is near); else nullopt.
  std::optional<double> clearance(const std::array<Vec3, 4>& tetrahedron, double slack) const;

 private:
  struct Node {
    Aabb box;
    int left = -1, right = -1;  // nodes; left < 0: a leaf with triangles first to last
    int first = 0, last = 0;
  };
  int build(int first, int last);
  void search(int node, const Vec3& p, Nearest& best) const;
  bool clears(int node, const Aabb& box, const std::array<Vec3, 4>& tetrahedron, double slack,
              double& width) const;

  const TriangleMesh& mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

/// The point of the closed triangle that is nearest to p.
Vec3 nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace touchstone::fuzz
