// Random surfaces of solids.
#pragma once

#include "core/math/rng.h"
#include "core/shape/shape.h"

namespace touchstone::fuzz {

/// An octahedron, also divided and rounded; a star of random radii; a prism with an L for its base; a ring; a
/// box with a cavity; a box.
SolidMesh random_solid(Rng& rng, double scale);

}  // namespace touchstone::fuzz
