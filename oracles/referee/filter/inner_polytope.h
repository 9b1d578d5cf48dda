// An inner polytope of D = core(A) - core(B), grown towards the point of D's boundary nearest to the origin
// (van den Bergen 2001, "Proximity queries and penetration depth computation on 3D game objects"), and the
// proof that a ball about the origin lies in D.
//
// Proof of `depth >= l`. Let F be a list of triangles whose vertices are points of a convex set D, such that
// (1) every directed edge is matched by its reverse, (2) the signed solid angles of the triangles at the
// origin have a sum > 0, (3) every triangle has distance >= l > 0 from the origin. By (1) F is a closed
// oriented surface (a 2-cycle; it need not be convex nor free of self-intersection) and has a winding number,
// an integer, about each point off it: about the origin it is the sum in (2) over 4π, so it is >= 1; by (3)
// it is the same about every point of the open ball of radius l. A point outside D has winding number 0,
// because F can be contracted within the convex D. So the ball is in D. For (2): tan(Ω/2) = det/(abc + ...)
// (van Oosterom and Strackee 1983) with a denominator of at most 4abc, so a triangle with det(v0,v1,v2) >= 0
// has Ω >= det/(4abc), and one with det < 0 (a sliver that rounding has turned over) has |Ω| <=
// area/distance². The comparison of the sums leaves a factor of 4 for their rounding. The distance in (3) is
// proven by any direction n with n·v_i >= l|n| for the triangle's three vertices. Vertices that are only
// within e of D, not in it, cost e: h_D >= h_F - e, and h_F >= l for the convex hull of F.
#pragma once

#include <array>
#include <vector>

#include "oracles/referee/filter/gjk.h"

namespace touchstone::referee {

template <class T>
struct BasicInnerPolytope {
  std::vector<BasicVertex<T>> vertices;
  std::vector<std::array<int, 3>> facets;
  std::vector<std::array<int, 3>> neighbours;  // facet across edge v[i], v[i+1]
};
using InnerPolytope = BasicInnerPolytope<Real>;

/// The radius of a ball about the origin that the polytope proves to lie in the convex hull of its vertices
/// (taken as exact numbers); 0 when it proves none. Relies only on vertices and facets: `neighbours` are
/// checked. Does not look for anything above `expected`, the distance of the nearest facet.
Real proven_inner_radius(const InnerPolytope& p, Real expected);

template <class T>
struct BasicEpaResult {
  enum class Exit { converged, stalled, facet_cap, flat };
  Exit exit = Exit::stalled;
  BasicCoreGap<T> gap;
  BasicSimplex<T> nearest;  // the facet nearest to the origin, with weights
  BasicInnerPolytope<T> polytope;
  /// For each facet: a proven lower bound of its distance from the origin, and det(v0, v1, v2), rounded.
  std::vector<T> reach, det;
  int nearest_facet = -1;
};
using EpaResult = BasicEpaResult<Real>;

/// How to decide on which side of a facet a point is. Rounded signs are fast but fail on runs of slivers
/// (many points of a flat face with a curved border), where the surface can fold and growth stalls; exact
/// signs keep it convex. Either way only proven_inner_radius is relied on.
enum class Orientation { rounded, exact };

/// `seed`: the final simplex of GJK. Also works when the origin is outside D, where it sharpens gap.lo for
/// face contacts.
EpaResult expand(const Difference& d, const Simplex& seed, Real target, int facet_cap,
                 Orientation orientation);

/// The same search in doubles, without the proof: gap.hi contains nothing that a facet would have to prove.
/// Precondition: `seed` has four vertices.
BasicEpaResult<double> search(const BasicDifference<double>& d, const BasicSimplex<double>& seed,
                              double target, int facet_cap);

/// The local minima of h_D(n) over unit n are the normals of those facets of D that contain the foot of the
/// origin.
struct Minima {
  struct Minimum {
    Real3 normal;
    Real value;  // h_D(normal), within the target of the search
  };
  std::vector<Minimum> found;  // least first; ends with the first one beyond the limit, if any
  bool complete = false;       // no local minimum below the last one is missing
  bool flat = false;           // D has no interior
};
/// The local minima of a polytope D, up to the first whose value is above the least + `slack` (or above
/// `least_known` + slack).
Minima local_minima(const Difference& d, const Simplex& seed, Real least_known, Real slack, Real target,
                    int facet_cap);

struct Confirmed {
  bool closed = false;         // the bracket is within `target` (it is proven either way)
  bool doubles_prove = false;  // double arithmetic suffices to prove that the origin is inside
  CoreGap gap;
  Simplex nearest;
};
/// What the polytope that `search` found in the doubles d0 of d proves about d itself. Facets that doubles
/// show to be farther away than the nearest one are not examined again. Precondition: both cores are
/// `points`.
Confirmed confirm(const Difference& d, const BasicDifference<double>& d0, const BasicEpaResult<double>& found,
                  Real target);

/// The vertex of D for the core vertices ia and ib; both cores must be `points`.
Vertex vertex_at(const Difference& d, int ia, int ib);

// Bounds of the depth by parts of the bodies. Where a vertex or an edge of one body lies on the axis of a
// body of revolution, a whole arc of directions is equally good, and an inner polytope needs 10^7 facets to
// show it; the vertex or the edge by itself is a body of revolution too, and meridian_bound measures it in a
// plane.
//
// Derivation. For A' in A and B' in B, h_A' <= h_A and h_B' <= h_B, so the depth of (A', B') is at most that
// of (A, B): a lower bound of the depth of the parts is one of the bodies. The best direction of the parts is
// tried for the bodies, as an upper bound. Both are equal where the parts alone decide.

/// Narrows `gap`, the bracket for the cores of d. `nearest`: the facet or simplex of d that is nearest to the
/// origin, with weights; any will do, but only a good one helps. Stops when the bracket is within `target`.
void bound_by_parts(const Difference& d, const Simplex& nearest, Real target, CoreGap& gap);

}  // namespace touchstone::referee
