// Closed surfaces of triangles, and random solids made of them.
#pragma once

#include "core/math/rng.h"
#include "core/shape/shape.h"

namespace touchstone::fuzz {

/// With vertices at distance 1 along each axis.
TriangleMesh octahedron();

/// Each triangle split into four. The new vertices stay in place, so that the four are coplanar, or are
/// projected to the unit sphere (`round`).
TriangleMesh divided(const TriangleMesh& m, bool round);

/// An octahedron, also divided and rounded; a star of random radii; a prism with an L for its base; a ring; a
/// box with a cavity; a box.
SolidMesh random_solid(Rng& rng, double scale);

}  // namespace touchstone::fuzz
