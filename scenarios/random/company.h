// Scenes of several bodies of which more is asked than of a crowd: with meshes, half-spaces, groups and
// ignored pairs; with shapes in common; with many questions one after the other, so that an engine that
// remembers what it must not remember shows it.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

void company(Rng& rng, Case& c);
void dialogue(Rng& rng, Case& c);

}  // namespace touchstone::fuzz
