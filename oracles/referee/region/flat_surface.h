// Where a mesh is a plane as far as a body reaches through it, so that the surface has a least depth and a
// normal (truth.md §2).
#pragma once

#include <optional>

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// The plane of the triangles that the body touches.
struct FlatSurface {
  Vec3 normal;    // unit within rounding, world; either side
  Bracket reach;  // of the least motion that separates body and mesh: along `normal` or against it
};

/// Precondition: a mesh and any body. The mesh equals one plane at every point nearer to the body than twice
/// `reach`: there all its triangles lie in the plane exactly, and each of their edges has triangles on both
/// sides. The body must then move by at least min(reach/|n·normal|, 2·reach) along a unit vector n to leave
/// the mesh. nullopt: this is not the case, or not shown (T-junctions, triangles without area, too
/// expensive); the bodies are apart; the body is neither bounded nor convex.
std::optional<FlatSurface> flat_surface(const Placed& mesh, const Placed& body);

}  // namespace touchstone::referee
