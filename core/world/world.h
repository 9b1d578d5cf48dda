// Whole scenes. Conventions for every engine that is compared with the core:
//
// * Candidate pairs: at each `query` step, the pairs (i < j, sorted) of bodies that are present, not filtered
//   (is_filtered: same group, or listed in `ignored`) and not both static. A body without motion has the box
//   of its pose at that step; a body with motion has the box of the whole step from that pose, so that a
//   swept contact is not missed.
// * Scene contacts: of the same pairs at the bodies' own poses (the script is not run), those that overlap,
//   with
//   depth and with the normal from the first to the second body. A pair that the narrow phase does not
//   support (half-space–half-space) is omitted and counted in `unsupported`.
#pragma once

#include <string_view>
#include <vector>

#include "core/broad/broad_phase.h"
#include "core/narrow/narrow_phase.h"
#include "core/scene/scene.h"

namespace touchstone {

/// False when the pair is filtered or both bodies are static.
bool is_reported(const Scene& scene, int a, int b);

/// Box of body i at `pose`; of the whole step when the body has a motion.
Aabb box_of(const Scene& scene, int body, const Pose& pose);

/// Runs effective_script(scene) through `phase`, ignoring motions; one sorted list per query step.
std::vector<std::vector<BodyPair>> candidate_pairs(const Scene& scene, broad::BroadPhase& phase);
/// The same for pairs that may be within the scene's margin, which is not negative: every box is widened by
/// half of it.
std::vector<std::vector<BodyPair>> candidate_pairs_within(const Scene& scene, broad::BroadPhase& phase);
/// The pairs that may overlap at some time of the step that starts at the bodies' own poses; sorted.
std::vector<BodyPair> swept_candidate_pairs(const Scene& scene, broad::BroadPhase& phase);

struct PairContact {
  int a = 0, b = 0;  // a < b
  ContactAnswer contact;
};

struct SceneContacts {
  Outcome outcome = Outcome::answered;  // not_converged when some pair is; the others are still reported
  std::vector<PairContact> contacts;    // overlapping pairs, sorted
  long candidates = 0, unsupported = 0;
};

SceneContacts scene_contacts(const Scene& scene, broad::BroadPhase& phase);

}  // namespace touchstone
