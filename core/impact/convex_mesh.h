// First contact of a moving convex body and a mesh at rest: the earliest of its triangles' own. The tree's
// boxes are entered by the ball about the body's origin that holds it at any rotation; what it enters after
// the earliest contact so far, or never, is left out.
#pragma once

#include "core/impact/filtered/mover.h"
#include "core/impact/impact.h"

namespace touchstone::ccd {

/// `frame` of the mesh about A's start; witness points come out there too. `accuracy`: of the gap
/// at a contact that is stated.
ImpactAnswer convex_mesh(const MovingShape& a, const TriangleMesh& mesh, const MeshTree* tree,
                         const WideFrame& frame, double accuracy);

}  // namespace touchstone::ccd
