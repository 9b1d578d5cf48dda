// FCL's broad-phase managers, each as an engine that answers only `candidates`. They are used as FCL
// documents: objects are registered, the initial ones in one call; computeAABB() after every move; then
// update() once after a series of moves or, as a separate engine, update(object) after each move; setup()
// before every query.
#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>
#include <fcl/config.h>
#include <fcl/narrowphase/collision_object.h>

#include <functional>
#include <memory>

#include "core/math/roundoff.h"
#include "oracles/abi/plugin_kit.h"
#include "oracles/fcl/shapes.h"

namespace touchstone::fcl_adapter {
namespace {

using Manager = fcl::BroadPhaseCollisionManagerd;
using ManagerPtr = std::unique_ptr<Manager>;

enum class Update { all, one };

struct Row {
  const char *name, *settings;
  ManagerPtr (*make)();
  Update update = Update::all;
};
template <class M>
ManagerPtr plain() {
  return std::make_unique<M>();
}
// FCL requires a cell size and world bounds; objects outside go to a separate list.
ManagerPtr spatial_hash() {
  return std::make_unique<fcl::SpatialHashingCollisionManagerd<>>(1.0, fcl::Vector3d::Constant(-1000),
                                                                  fcl::Vector3d::Constant(1000));
}

constexpr Row rows[] = {
    {"fcl-naive", "NaiveCollisionManager", &plain<fcl::NaiveCollisionManagerd>},
    {"fcl-sap", "SaPCollisionManager", &plain<fcl::SaPCollisionManagerd>},
    {"fcl-ssap", "SSaPCollisionManager", &plain<fcl::SSaPCollisionManagerd>},
    {"fcl-interval-tree", "IntervalTreeCollisionManager", &plain<fcl::IntervalTreeCollisionManagerd>},
    {"fcl-spatial-hash", "SpatialHashingCollisionManager, cells of 1, world of ±1000", &spatial_hash},
    {"fcl-dynamic-tree", "DynamicAABBTreeCollisionManager", &plain<fcl::DynamicAABBTreeCollisionManagerd>},
    {"fcl-dynamic-tree-array", "DynamicAABBTreeCollisionManager_Array",
     &plain<fcl::DynamicAABBTreeCollisionManager_Arrayd>},
    // Managers with their own update(object); in the others it calls update().
    {"fcl-sap-update-one", "SaPCollisionManager", &plain<fcl::SaPCollisionManagerd>, Update::one},
    {"fcl-interval-tree-update-one", "IntervalTreeCollisionManager",
     &plain<fcl::IntervalTreeCollisionManagerd>, Update::one},
    {"fcl-spatial-hash-update-one", "SpatialHashingCollisionManager, cells of 1, world of ±1000",
     &spatial_hash, Update::one},
    {"fcl-dynamic-tree-update-one", "DynamicAABBTreeCollisionManager",
     &plain<fcl::DynamicAABBTreeCollisionManagerd>, Update::one},
    {"fcl-dynamic-tree-array-update-one", "DynamicAABBTreeCollisionManager_Array",
     &plain<fcl::DynamicAABBTreeCollisionManager_Arrayd>, Update::one},
};

class Run {
 public:
  using Pair = std::function<void(int, int)>;

  Run(const ts_scene& scene, const std::vector<Geometry>& geometries, const Row& row)
      : scene_(scene),
        geometries_(geometries),
        objects_(scene.body_count),
        manager_(row.make()),
        update_(row.update) {}

  void apply(const ts_step& step) {
    // A manager finds objects by the boxes that it last saw, so pending moves must be applied first.
    if (step.op != TS_MOVE) flush();
    fcl::CollisionObjectd*& o = objects_[static_cast<std::size_t>(step.body)];
    if (step.op == TS_REMOVE) {
      register_first();
      manager_->unregisterObject(o);
      return;
    }
    if (step.op == TS_INSERT)
      o = make_object(step.body);
    else
      register_first();
    o->setTransform(make_transform(kit::pose_of(step.pose)));
    o->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(step.body)));
    o->computeAABB();
    if (step.op == TS_MOVE)
      moved(o);
    else if (started_)
      manager_->registerObject(o);
    else
      first_.push_back(o);
  }

  void query(Pair pair) {
    register_first();
    flush();
    manager_->setup();
    manager_->collide(&pair, [](fcl::CollisionObjectd* one, fcl::CollisionObjectd* two, void* data) {
      const auto index = [](const fcl::CollisionObjectd* o) {
        return static_cast<int>(reinterpret_cast<std::intptr_t>(o->getUserData()));
      };
      (*static_cast<Pair*>(data))(index(one), index(two));
      return false;
    });
  }

 private:
  fcl::CollisionObjectd* make_object(int body) {
    owned_.push_back(std::make_unique<fcl::CollisionObjectd>(
        geometries_[static_cast<std::size_t>(scene_.bodies[body].shape)]));
    return owned_.back().get();
  }
  void moved(fcl::CollisionObjectd* o) {
    if (update_ == Update::one)
      manager_->update(o);
    else
      moved_ = true;
  }
  // Registers all initial objects in one call, which FCL's managers handle best.
  void register_first() {
    if (started_) return;
    started_ = true;
    manager_->registerObjects(first_);
    manager_->setup();
  }
  void flush() {
    if (moved_) manager_->update();
    moved_ = false;
  }

  const ts_scene& scene_;
  const std::vector<Geometry>& geometries_;
  // Objects live until the end, so that a manager that still refers to a removed one reports a stale pair
  // instead of reading memory freed by this adapter.
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> owned_;
  std::vector<fcl::CollisionObjectd*> objects_, first_;
  ManagerPtr manager_;
  Update update_;
  bool started_ = false, moved_ = false;
};

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> all;
    for (const Row& r : rows)
      all.push_back(
          {r.name, "FCL", FCL_VERSION,
           std::string(r.settings) + " alone; computeAABB and " +
               (r.update == Update::one ? "update(object) after each move" : "update() after moves") +
               ", setup() before queries",
           double_roundoff, kit::oracle_tau_factor, "fcl/broadphase: no tolerance"});
    return all;
  }
  explicit Engine(unsigned index) : row_(rows[index]) {}

  void load(const ts_scene& scene, const ts_received&) {
    unload();
    for (std::size_t i = 0; i < scene.shape_count; ++i) {
      geometries_.push_back(make_geometry(scene.shapes[i]));
      geometries_.back()->computeLocalAABB();
    }
    scene_ = &scene;
    filter_ = kit::PairFilter(scene);
  }
  void unload() {
    geometries_.clear();
    scene_ = nullptr;
  }

  void ask(ts_question question, int, int, ts_answer&, const ts_sink& sink) {
    if (question != TS_CANDIDATES) throw kit::Unsupported("a broad phase only");
    Run run(*scene_, geometries_, row_);
    kit::run_script(
        *scene_, [&](const ts_step& step) { run.apply(step); },
        [&](int k) { run.query([&](int a, int b) { report(sink, k, a, b); }); });
  }

 private:
  void report(const ts_sink& sink, int k, int a, int b) const {
    // A manager that reads freed memory may report nonexistent bodies; the harness detects that.
    const auto is_body = [&](int i) { return i >= 0 && i < static_cast<int>(scene_->body_count); };
    if (!is_body(a) || !is_body(b) || filter_.is_reportable(a, b)) sink.pair(sink.ctx, k, a, b);
  }
  const Row& row_;
  const ts_scene* scene_ = nullptr;
  std::vector<Geometry> geometries_;
  kit::PairFilter filter_;
};

}  // namespace
}  // namespace touchstone::fcl_adapter

TS_PLUGIN(touchstone::fcl_adapter::Engine)
