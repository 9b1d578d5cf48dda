// Edge graph of the vertices of a large hull. Its support point is found by climbing from vertex to vertex
// instead of scanning all of them (Gino van den Bergen 1999, "A fast and robust GJK implementation for
// collision detection of convex objects"). Departure: the start comes from a table of directions instead of
// the last support point, so that no state is kept and queries can run concurrently. The graph belongs to
// the hull's collider; a query without one scans every vertex. The answers are the same: climbing finds
// exactly the vertex that the scan finds (core/shape/vertex_climb.h).
//
// This relies on the surface being that of a convex polytope exactly, not just to qhull's rounding.
// Construction proves it (Mehlhorn, Näher, Seidel, Seel, Schirra, Uhrig 1999, "Checking geometric programs or
// verification of geometric structures") with exact signs:
//
// * every directed edge belongs to one face and its reverse to another: a closed surface;
// * a point o is strictly below every face: seen from o, no face is degenerate or reversed, and the surface
//   covers the sphere around o uniformly, except perhaps at vertices;
// * a ray from o through one face meets no other face: the surface covers the sphere once;
// * across each edge, the adjacent face's corner is not above the plane of this face: locally convex, hence
//   convex.
//
// Vertices that belong to no face must be deep enough inside that no rounding of a support value lifts them
// above the surface. A hull that fails has no graph; the usual reason is faces that are coplanar up to the
// rounding of their corners (a rotated prism).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace touchstone {

struct Hull;

/// Hulls with fewer vertices get no graph: scanning all of them, four at once, is as fast. With one direction
/// after another, the two break even at 80 vertices (128: 52 against 82 ns, 512: 47 against 208; EPYC,
/// 2026-11). But when every query has a different hull, whose graph is not in the cache, a contact with 128
/// vertices takes 5.9 µs by climbing and 4.8 by scanning; with 512, 8.0 and 12.8.
inline constexpr std::size_t hull_graph_least = 256;

/// Larger hulls get no graph either: vertex indices have 16 bits.
inline constexpr std::size_t hull_graph_most = 0xffff;

struct HullGraph {
  /// Neighbours of vertex i: neighbour[first[i]] … neighbour[first[i + 1] − 1]. Empty: no graph.
  std::vector<std::int32_t> first;
  std::vector<std::uint16_t> neighbour;  // 16 bits: cache misses cost more than climbing
  /// Start vertex for a direction, one for each cell of a cube's faces: cells × cells per face, faces ordered
  /// +x, −x, +y, …; any vertex would be valid.
  std::vector<std::uint16_t> start;
  int cells = 0;
  double reach = 0;  // of the vertices about the origin
  explicit operator bool() const { return !first.empty(); }
};

/// The graph is valid for this hull only, and only while the hull is unchanged. Hulls with fewer than `least`
/// vertices get an empty graph.
HullGraph build_hull_graph(const Hull& hull, std::size_t least = hull_graph_least);

}  // namespace touchstone
