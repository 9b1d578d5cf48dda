#include "oracles/fcl/queries.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision_object.h>

#include <cstdint>
#include <memory>

namespace touchstone::fcl_adapter {
namespace {

class Tree {
 public:
  Tree(const ts_scene& scene, const std::vector<Geometry>& geometries)
      : scene_(scene), geometries_(geometries), objects_(scene.body_count) {}

  void insert(int body, const ts_pose& pose) {
    owned_.push_back(std::make_unique<fcl::CollisionObjectd>(
        geometries_[static_cast<std::size_t>(scene_.bodies[body].shape)],
        make_transform(kit::pose_of(pose))));
    fcl::CollisionObjectd* o = owned_.back().get();
    objects_[static_cast<std::size_t>(body)] = o;
    o->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(body)));
    o->computeAABB();
    manager_.registerObject(o);
    stale_ = true;
  }
  // Managers do not call computeAABB themselves.
  void move(int body, const ts_pose& pose) {
    fcl::CollisionObjectd& o = *objects_[static_cast<std::size_t>(body)];
    o.setTransform(make_transform(kit::pose_of(pose)));
    o.computeAABB();
    manager_.update(&o);
  }
  void remove(int body) { manager_.unregisterObject(objects_[static_cast<std::size_t>(body)]); }
  void query(const std::function<void(int, int)>& pair) {
    if (stale_) manager_.setup();
    stale_ = false;
    auto copy = pair;
    manager_.collide(&copy, [](fcl::CollisionObjectd* one, fcl::CollisionObjectd* two, void* data) {
      const auto index = [](const fcl::CollisionObjectd* o) {
        return static_cast<int>(reinterpret_cast<std::intptr_t>(o->getUserData()));
      };
      (*static_cast<std::function<void(int, int)>*>(data))(index(one), index(two));
      return false;
    });
  }

 private:
  const ts_scene& scene_;
  const std::vector<Geometry>& geometries_;
  // Removed objects are kept as well, because the manager may still refer to them.
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> owned_;
  std::vector<fcl::CollisionObjectd*> objects_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
  bool stale_ = false;
};

}  // namespace

void run_script(const ts_scene& scene, const std::vector<Geometry>& geometries,
                const std::function<void(int, int, int)>& pair) {
  Tree tree(scene, geometries);
  const auto apply = [&](const ts_step& step) {
    if (step.op == TS_INSERT) tree.insert(step.body, step.pose);
    if (step.op == TS_MOVE) tree.move(step.body, step.pose);
    if (step.op == TS_REMOVE) tree.remove(step.body);
  };
  kit::run_script(scene, apply, [&](int k) { tree.query([&](int a, int b) { pair(k, a, b); }); });
}

void all_pairs(const ts_scene& scene, const std::vector<Geometry>& geometries,
               const std::function<void(int, int)>& pair) {
  Tree tree(scene, geometries);
  for (std::size_t i = 0; i < scene.body_count; ++i) tree.insert(static_cast<int>(i), scene.bodies[i].pose);
  tree.query(pair);
}

}  // namespace touchstone::fcl_adapter
