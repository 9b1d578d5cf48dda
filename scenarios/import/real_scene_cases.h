// A recorded scene as cases: per frame the whole scene (candidate pairs, contacts), and each pair of bodies
// whose exact boxes overlap as a pair case of its own (overlap, distance, contact; time of impact when the
// recording moves).
#pragma once

#include <string>
#include <vector>

#include "scenarios/import/real_scene.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// "first:end:step" as of a Python range; empty: about five frames spread evenly. Throws InputError when it
/// is no range.
std::vector<int> frames_from_text(const std::string& text, int frame_count);

std::vector<Case> real_scene_cases(const RealScene& scene, int frame);

}  // namespace touchstone::fuzz
