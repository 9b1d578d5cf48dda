// Scenes of several bodies with more demanding queries than a crowd: with meshes, half-spaces, groups and
// ignored pairs; with shared shapes; with many queries in a row, which reveals an engine that keeps state it
// must not keep.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

void company(Rng& rng, Case& c);
void dialogue(Rng& rng, Case& c);

}  // namespace touchstone::fuzz
