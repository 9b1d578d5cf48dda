// FCL's best managers, boxes as collision objects: the dynamic AABB tree with pointers and the one on arrays.
//
// The array tree loses pairs once it has rebalanced itself top down (FCL 0.7.0, after large moves: teleport,
// mixed): balanceTopdown() renumbers the leaves in the order of the old tree, while the manager's table from
// object to leaf keeps the old numbers, so that later updates go to other objects' leaves. Its rows are then
// marked; the tree with pointers keeps its leaves and is the FCL method to compare with there.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>

#include "tests/bench/broad_scenes.h"

namespace touchstone::bench {
namespace {

// A collision object whose box is set directly.
class BoxObject : public fcl::CollisionObjectd {
 public:
  explicit BoxObject(int i) : fcl::CollisionObjectd(std::make_shared<fcl::Boxd>(1, 1, 1)), id(i) {}
  void set(const Aabb& b) { aabb = fcl::AABBd(b.lo, b.hi); }
  int id;
};

template <class Manager>
class FclTree final : public Contestant {
 public:
  void start(const std::vector<Aabb>& boxes) override {
    std::vector<fcl::CollisionObjectd*> all;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      objects_.push_back(std::make_unique<BoxObject>(static_cast<int>(i)));
      objects_.back()->set(boxes[i]);
      all.push_back(objects_.back().get());
    }
    manager_.registerObjects(all);
    manager_.setup();
  }
  void frame(const std::vector<broad::BoxUpdate>& moves, std::vector<broad::IdPair>& out) override {
    moved_.clear();
    for (const broad::BoxUpdate& m : moves) {
      BoxObject& o = *objects_[static_cast<std::size_t>(m.id)];
      o.set(m.box);
      moved_.push_back(&o);
    }
    manager_.update(moved_);
    out.clear();
    manager_.collide(&out, [](fcl::CollisionObjectd* one, fcl::CollisionObjectd* two, void* data) {
      const int a = static_cast<BoxObject*>(one)->id, b = static_cast<BoxObject*>(two)->id;
      if (one->getAABB().overlap(two->getAABB()))
        static_cast<std::vector<broad::IdPair>*>(data)->push_back({std::min(a, b), std::max(a, b)});
      return false;
    });
  }

 private:
  std::vector<std::unique_ptr<BoxObject>> objects_;
  std::vector<fcl::CollisionObjectd*> moved_;
  Manager manager_;
};

}  // namespace

std::unique_ptr<Contestant> make_fcl_tree() {
  return std::make_unique<FclTree<fcl::DynamicAABBTreeCollisionManagerd>>();
}
std::unique_ptr<Contestant> make_fcl_tree_array() {
  return std::make_unique<FclTree<fcl::DynamicAABBTreeCollisionManager_Arrayd>>();
}

}  // namespace touchstone::bench
