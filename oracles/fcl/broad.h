// Runs a script on FCL's dynamic AABB tree in the way a user would.
#pragma once

#include <functional>
#include <vector>

#include "oracles/abi/plugin_kit.h"
#include "oracles/fcl/shapes.h"

namespace touchstone::fcl_adapter {

/// Runs the scene's steps; calls `pair(k, a, b)` for every pair that the manager's callback receives at the
/// k-th query.
void run_script(const ts_scene& scene, const std::vector<Geometry>& geometries,
                const std::function<void(int k, int a, int b)>& pair);

/// Calls `pair` for every pair that the manager's callback receives, with all bodies at their own poses.
void all_pairs(const ts_scene& scene, const std::vector<Geometry>& geometries,
               const std::function<void(int a, int b)>& pair);

}  // namespace touchstone::fcl_adapter
