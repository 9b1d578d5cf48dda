// A recorded scene as cases: for each frame the whole scene (candidate pairs, contacts), and a pair case for
// each pair of bodies whose exact boxes overlap (overlap, distance, contact; time of impact when the
// recording moves).
#pragma once

#include <string>
#include <vector>

#include "scenarios/import/real_scene.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// "first:end:step" as in a Python range; empty: about five evenly spread frames. Throws InputError when it
/// is not a valid range.
std::vector<int> frames_from_text(const std::string& text, int frame_count);

std::vector<Case> real_scene_cases(const RealScene& scene, int frame);

}  // namespace touchstone::fuzz
