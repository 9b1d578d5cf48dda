// What every case with an expectation must satisfy.
#pragma once

#include "scenarios/handmade/scenario.h"

namespace touchstone::test {

/// Checks (with Catch2) that the scene is valid, that the questions can be asked, and that the expectation
/// contradicts neither itself nor the scene.
void check_case(const Case& c, const Expectation& e);

/// Pairs of bodies whose exact shapes share a point according to the referee, at the bodies' own poses,
/// filtered ones excluded; `poses` replaces the bodies' own. Bodies for which `present` is false are left
/// out.
std::vector<BodyPair> overlapping_pairs(const Scene& scene, const std::vector<Pose>& poses,
                                        const std::vector<bool>& present);

std::vector<Pose> own_poses(const Scene& scene);

}  // namespace touchstone::test
