// An inner polytope of D = core(A) - core(B), grown towards the point of D's boundary nearest to the origin
// (van den Bergen 2001, "Proximity queries and penetration depth computation on 3D game objects"), and the
// proof that a ball about the origin lies in D.
//
// Proof of `depth >= l`. Let F be a list of triangles whose vertices are points of a convex set D, such that
// (1) every directed edge is matched by its reverse, (2) det(v0,v1,v2) >= 0 for every triangle and > 0 for
// one, (3) every triangle has distance >= l > 0 from the origin. By (1) F is a closed oriented surface (a
// 2-cycle; it need not be convex nor free of self-intersection), by (2) the signed solid angles of its
// triangles at the origin are >= 0 and not all 0, so its winding number about the origin, an integer, is >=
// 1; by (3) it is the same about every point of the open ball of radius l. A point outside D has winding
// number 0, because F can be contracted inside the convex D. So the ball is in D. The distance in (3) is
// proven by any direction n with n·v_i >= l|n| for the triangle's three vertices. Vertices that are within e
// of D instead of in it cost e: h_D >= h_F - e, and h_F >= l for the convex hull of F.
#pragma once

#include <array>
#include <vector>

#include "oracles/referee/gjk.h"

namespace touchstone::referee {

struct InnerPolytope {
  std::vector<Vertex> vertices;
  std::vector<std::array<int, 3>> facets;
};

/// The radius of a ball about the origin that the polytope proves to lie in the convex hull of its vertices
/// (taken as exact numbers); 0 when it proves none. Reads nothing but vertices and facets.
Real proven_inner_radius(const InnerPolytope& p);

struct EpaResult {
  enum class Exit { converged, stalled, facet_cap, flat };
  Exit exit = Exit::stalled;
  CoreGap gap;
  Simplex nearest;  // the facet nearest to the origin, with weights
  InnerPolytope polytope;
};

/// `seed`: what GJK ended with. Also works when the origin is outside D, where it sharpens gap.lo for face
/// contacts.
EpaResult expand(const Difference& d, const Simplex& seed, Real target, int facet_cap);

}  // namespace touchstone::referee
