// Meshes from one triangle to hundreds, open, closed, folded and flat; hulls with many vertices.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

void meshes(Rng& rng, Case& c);
void many_vertices(Rng& rng, Case& c);

Shape any_mesh(Rng& rng, double scale);

}  // namespace touchstone::fuzz
