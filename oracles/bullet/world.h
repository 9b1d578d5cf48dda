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

/// The bodies of a scene as a user of btCollisionWorld has them: those of a group, if they are convex, are
/// the child shapes of one btCompoundShape, whose object stands where the first of them does; every other
/// body is an object of its own.
class Assembly {
 public:
  /// `objects`, by body, outlive the assembly.
  Assembly(const ts_scene& scene, Objects& objects);
  const std::vector<btCollisionObject*>& objects() const { return all_; }
  /// The body of a contact's shape: `index` is that of the child, which only compounds have.
  int body_of(const btCollisionObject& object, int index) const;

 private:
  struct Compound {
    btCompoundShape shape;
    btCollisionObject object;
    std::vector<int> bodies;
  };
  int bodies_ = 0;  // the user index of a compound's object is this and the number of the compound
  std::vector<std::unique_ptr<Compound>> compounds_;
  std::vector<btCollisionObject*> all_;
};

/// Calls `pair` with the user indices of each pair in the world's overlapping pair cache.
void for_each_cached_pair(btCollisionWorld& world, const std::function<void(int a, int b)>& pair);

/// Runs the scene's steps; calls `pair(k, a, b)` for every pair in the cache at the k-th query. The user
/// index of each object is the number of its body.
void run_script(const ts_scene& scene, Objects& objects, World& world,
                const std::function<void(int k, int a, int b)>& pair);

}  // namespace touchstone::bullet_adapter
