// btCollisionWorld as a user sets it up: default configuration, dispatcher, dynamic AABB tree.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "oracles/bullet/shapes.h"

namespace touchstone::bullet_adapter {

/// A fresh world. The configuration is shared between worlds: it owns megabytes of memory pools but no state.
class World {
 public:
  explicit World(btDefaultCollisionConfiguration& configuration)
      : dispatcher_(&configuration), world_(&dispatcher_, &broadphase_, &configuration) {}
  btCollisionWorld* operator->() { return &world_; }
  btCollisionWorld& operator*() { return world_; }

 private:
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_;
};

using Objects = std::vector<std::unique_ptr<btCollisionObject>>;

/// Calls `pair` with the user indices of each pair in the world's overlapping pair cache.
void for_each_cached_pair(btCollisionWorld& world, const std::function<void(int a, int b)>& pair);

/// Runs the scene's steps; calls `pair(k, a, b)` for every pair in the cache at the k-th query. The user
/// index of each object is the number of its body.
void run_script(const ts_scene& scene, Objects& objects, World& world,
                const std::function<void(int k, int a, int b)>& pair);

}  // namespace touchstone::bullet_adapter
