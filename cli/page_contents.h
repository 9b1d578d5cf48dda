// What `view` puts on its pages.
#pragma once

#include <string>
#include <vector>

#include "cli/engine_catalog.h"
#include "core/scene/scene.h"
#include "reports/assess/assess.h"
#include "reports/record/broad_view.h"
#include "reports/record/observation_json.h"
#include "scenarios/codec/case_codec.h"

namespace touchstone::cli {

// The data that reports/web/src/case draws.

/// The case, the answers of `engines` as in `replay --json`, and the faces of hulls. For each engine that is
/// wrong about a pair also its stages (as found by `bisect stage`) and the program against its own API (as
/// written by `reproduce`), unless that is too long. `named` is the user's name for the case.
fuzz::Json case_page(const std::string& named, const StoredCase& stored, const std::string& engines,
                     const WorkerLimits& limits);

/// The triangles of the hulls of a scene, by the number of the shape.
fuzz::Json hull_faces(const Scene& scene);

// The data that reports/web/src/assess draws.

/// The assessment, its words, and the pairs that engines got wrong with what every engine says about them,
/// asked again. `all`: the configurations that were asked.
fuzz::Json assess_page(const Model& model, const std::vector<Configuration>& all,
                       const fuzz::Assessment& assessment, const std::vector<EnginePtr>& engines,
                       const std::string& command);

}  // namespace touchstone::cli

namespace touchstone::fuzz {

// Runs a scene's script through broad phases of the core and records what they did at each query.

/// Scenes with more bodies are refused, because the picture compares all pairs.
inline constexpr std::size_t broad_view_most_bodies = 2000;

/// Records the first `most_frames` queries. Throws InputError on an unknown method or too many bodies, and
/// std::logic_error when two methods report different pairs.
BroadView broad_view(const Scene& scene, const std::vector<std::string>& methods, std::size_t most_frames);

}  // namespace touchstone::fuzz
