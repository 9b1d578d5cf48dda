// Engines that answer like our core, except for one lie each. A campaign must find every lie, by the check
// that it is made for. A lie that the definition of the right answer allows (duplicate pairs, a manifold of
// one point of a face, superfluous candidates) is not a mutant: those are charted, not judged.
#pragma once

#include <vector>

#include "oracles/abi/engine.h"
#include "tests/mutants/mutant.h"

namespace touchstone::mutants {

/// All of them, in the order of their topics: broad phase, overlap, distance, contact, impact, outcome,
/// scene, relations, regimes, memory, step, triggers, symptoms, margins, gradients, solids.
const std::vector<Mutant>& mutants();

EnginePtr make_lying_engine(const Mutant& m);

}  // namespace touchstone::mutants
