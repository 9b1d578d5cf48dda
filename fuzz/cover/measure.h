// How far a mesh sticks out of convex pieces, how far the pieces reach beyond it, and how much larger they
// are: brackets by branch and bound.
#pragma once

#include <atomic>
#include <span>

#include "core/shape/hull.h"
#include "core/shape/triangle_mesh.h"
#include "fuzz/cover/exact_hull.h"
#include "oracles/referee/referee.h"

namespace touchstone::fuzz {

/// The searches end when the bracket's ends differ by at most this share of the upper one.
inline constexpr double bracket_share = 0.01;
/// And at the latest after so many parts of triangles or pieces.
inline constexpr std::size_t most_parts = 100'000;

/// lo <= truth <= hi; `at`: a point where the quantity is at least lo.
struct Reach {
  referee::Bracket bracket;
  Vec3 at = Vec3::Zero();
};

/// The largest distance of a point of the triangles from the union of the pieces. The distances of points are
/// the referee's brackets; what rounding moves a point by is added.
Reach sticking_out(const TriangleMesh& mesh, std::span<const int> triangles, std::span<const Hull> pieces,
                   const std::atomic<bool>& stop);

/// Whether each edge is in two triangles that pass it in opposite directions: then the mesh is the surface of
/// a solid, or of several.
bool is_closed(const TriangleMesh& mesh);

/// The largest distance of a point of the union of the pieces from the solid inside a closed mesh.
Reach reaching_beyond(std::span<const ExactHull> pieces, const TriangleMesh& closed,
                      const std::atomic<bool>& stop);

/// The volume inside a closed mesh; negative if its triangles face inward.
double volume_inside(const TriangleMesh& closed);

/// The volume of the union of the pieces: of each piece, what is in none of those before it, in convex parts.
referee::Bracket volume_of_union(std::span<const ExactHull> pieces, const std::atomic<bool>& stop);

}  // namespace touchstone::fuzz
