// What reducing a case must keep for the smallest case to show what the campaign found: the engine's same
// fault, in the same routine of the library if its routines are known, about bodies that move or rest as
// before. Otherwise a ghost shrinks to a missed overlap, a box against a mesh to two spheres, and a moving
// body to one that overlaps from the start.
#pragma once

#include <optional>
#include <string>

#include "fuzz/causes/classes.h"
#include "fuzz/causes/symptom.h"
#include "fuzz/shrink/shrink.h"
#include "oracles/abi/engine.h"

namespace touchstone::fuzz {

struct Kept {
  Symptom symptom;
  std::string fault;                 // as in findings: "ghost", "crashed_gjk-c-177", "relation_scale"
  std::optional<std::string> route;  // EngineKnowledge::route_of; empty: any
  std::optional<bool> moves;         // whether one of the bodies concerned moves; empty: either
  std::optional<bool> parts;         // parts_from_start(), where the engine documents that; empty: either
};

/// What the engine shows in the case under the finding. Where it shows nothing, or both moving and resting
/// bodies, `moves` is empty.
Kept kept_of(const Case& c, const Finding& f, const EnginePtr& engine, const EngineKnowledge& knowledge);

/// For each case, whether the engine shows it. `engine` and `knowledge` must outlive the result.
StillShows keeps(const EnginePtr& engine, Kept kept, const EngineKnowledge& knowledge);

}  // namespace touchstone::fuzz
