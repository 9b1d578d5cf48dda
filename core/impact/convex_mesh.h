// First contact of a moving convex body and a mesh at rest: the earliest over its triangles. The tree's boxes
// are tested against the ball about the body's origin that contains it at any rotation; boxes that the ball
// enters never, or later than the earliest contact so far, are skipped.
#pragma once

#include "core/impact/filtered/mover.h"
#include "core/impact/impact.h"

namespace touchstone::impact {

/// `frame`: the mesh's pose relative to A's start; witness points are returned in the same coordinates.
/// `accuracy`: accuracy of the gap at a reported contact.
ImpactAnswer convex_mesh(const MovingShape& a, const TriangleMesh& mesh, const MeshTree* tree,
                         const WideFrame& frame, double accuracy);

}  // namespace touchstone::impact
