// Scenes as a whole: candidate pairs of a script, and contacts (broad and narrow phase together).
//
// Which pairs count: two bodies that are not both static, not of one group, and not listed as ignored.
#pragma once

#include <vector>

#include "core/broad/broad_phase.h"
#include "core/narrow/narrow_phase.h"
#include "core/scene/scene.h"

namespace touchstone {

/// Throws broad::Refused when the broad phase refuses a step. For each query of the scene's script, the pairs
/// whose boxes overlap, sorted. Bodies with a motion are given their swept boxes, so that pairs that meet at
/// any time of the step are candidates.
std::vector<std::vector<BodyPair>> candidate_pairs(const Scene& scene, broad::BroadPhase& broad_phase);

struct WorldContact {
  BodyPair bodies;
  ContactAnswer contact;  // normal from bodies.first to bodies.second
};

/// Contacts of all pairs that overlap at the bodies' own poses; pairs that the narrow phase has no answer for
/// come with their outcome. Sorted by pair.
std::vector<WorldContact> world_contacts(const Scene& scene, broad::BroadPhase& broad_phase);

}  // namespace touchstone
