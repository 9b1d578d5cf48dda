// Runs a scene's script through broad phases of the core and records what they did at each query.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "reports/record/broad_view.h"

namespace touchstone::fuzz {

/// Scenes with more bodies are refused, because the picture compares all pairs.
inline constexpr std::size_t broad_view_most_bodies = 2000;

/// Records the first `most_frames` queries. Throws InputError on an unknown method or too many bodies, and
/// std::logic_error when two methods report different pairs.
BroadView broad_view(const Scene& scene, const std::vector<std::string>& methods, std::size_t most_frames);

}  // namespace touchstone::fuzz
