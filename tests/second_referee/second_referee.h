// What CGAL says about pairs of polytopes and of meshes, in exact arithmetic. CGAL's headers are included by
// cgal_gap.cpp and cgal_overlap.cpp alone.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace touchstone::second_referee {

/// Vertices whose coordinates are integers below 2^53; the true ones are these divided by `scale`.
struct Polytope {
  std::vector<Vec3> vertices;
};

/// CGAL::Polytope_distance_d, in exact floats, about the two convex hulls.
struct Gap {
  bool overlap = false;    // the distance is 0
  bool is_within = false;  // lo <= distance / scale <= hi, decided exactly; false if they overlap
};
Gap gap_of(const Polytope& a, const Polytope& b, double scale, double lo, double hi);

/// Whether two surfaces share a point: CGAL::box_intersection_d proposes pairs of triangles, do_intersect of
/// the exact-predicates kernel decides. Triangles must have an area.
bool overlap(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace touchstone::second_referee
