// Which vertices of a large hull are joined by edges, so that its support point is found by climbing from
// vertex to vertex instead of looking at all (Gino van den Bergen 1999, "A fast and robust GJK implementation
// for collision detection of convex objects"; with the start from a table of directions instead of the last
// support point, so that nothing is remembered and queries may run side by side). Built once a hull and given
// to queries by PlacedShape::graph; a query without one looks at every vertex. Same answers: climbing finds
// the very vertex that looking at all finds (core/narrow/filtered/vertex_climb.h).
//
// That rests on the surface being that of a convex polytope, exactly and not to qhull's rounding. It is
// proven here (Mehlhorn, Näher, Seidel, Seel, Schirra, Uhrig 1999, "Checking geometric programs or
// verification of geometric structures"), all signs exact:
//
// * every directed edge belongs to one face, its reverse to another: a closed surface;
// * a point o is strictly below every face: seen from o, no face is degenerate or turned over, and the
// surface
//   covers the sphere around o evenly but perhaps at vertices;
// * a ray from o through one face meets no other: it covers the sphere once;
// * across each edge the next face's corner is not above the plane of this one: locally convex, hence convex.
//
// Vertices in no face must be deep enough inside that no rounding of a support value lifts them over the
// surface. A hull that fails has no graph: faces that are coplanar but for the rounding of their corners (a
// turned prism) are the usual reason.
#pragma once

#include <cstdint>
#include <vector>

#include "core/shape/hull.h"

namespace touchstone {

/// Hulls of fewer vertices have no graph: looking at all of them, four at once, is as fast. One direction
/// after the other the two meet at 80 vertices (128: 52 against 82 ns, 512: 47 against 208; EPYC, 2026-11),
/// but in queries of ever other hulls, whose graphs are not in the cache, contacts of 128 vertices take 5.9
/// µs by climbing and 4.8 by looking, of 512 8.0 and 12.8.
inline constexpr std::size_t hull_graph_least = 256;

/// Nor have larger ones.
inline constexpr std::size_t hull_graph_most = 0xffff;

struct HullGraph {
  /// Neighbours of vertex i: neighbour[first[i]] … neighbour[first[i + 1] − 1]. Empty: there is no graph.
  std::vector<std::int32_t> first;
  std::vector<std::uint16_t> neighbour;  // two bytes: what is not in the cache costs more than climbing
  /// Where to start for a direction: a vertex for each cell of a cube's faces, cells × cells each, the face's
  /// axis in order, +x, −x, +y, …; any vertex would do.
  std::vector<std::uint16_t> start;
  int cells = 0;
  double reach = 0;  // of the vertices about the origin
  explicit operator bool() const { return !first.empty(); }
};

/// The same hull, not changed since, goes with the graph. `least`: vertices below which there is none.
HullGraph build_hull_graph(const Hull& hull, std::size_t least = hull_graph_least);

}  // namespace touchstone
