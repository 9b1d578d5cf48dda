// The engines that plug-ins offer, as their own cards state them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/value/engine_card.h"

namespace touchstone::cli {

/// What an engine is for. The name of its plug-in's file says it: `_broad`, `_sweep`, or neither.
enum class EngineKind {
  pairs,     // more than candidates
  broad,     // candidates only, requested by name
  settings,  // other tolerances: requested by name, and drawn by `chart` as points of a curve
};

struct PluginEngine {
  std::filesystem::path plugin;
  std::string engine;  // its name in the plug-in
  EngineKind kind = EngineKind::pairs;
  EngineCard card;  // as shown
};

/// The plug-ins in a folder that belong to the engine folder `name`, libtouchstone_NAME.so and
/// libtouchstone_NAME_*.so, sorted.
std::vector<std::filesystem::path> plugins_of(const std::filesystem::path& folder, const std::string& name);

/// The engines of a plug-in, in its own order. A worker reads them, once in the life of this program. Throws
/// InputError when the plug-in cannot be loaded.
const std::vector<PluginEngine>& engines_in(const std::filesystem::path& plugin);

/// The same for several plug-ins.
std::vector<PluginEngine> engines_in(const std::vector<std::filesystem::path>& plugins);

}  // namespace touchstone::cli
