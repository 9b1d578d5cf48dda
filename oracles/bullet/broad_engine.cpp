// Bullet's broad phases, each as an engine that answers only `candidates`: proxies with the shapes' own AABBs
// (margin 0), without a btCollisionWorld, which would expand them.
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btSimpleBroadphase.h>

#include <cmath>
#include <limits>
#include <memory>

#include "oracles/abi/plugin_kit.h"
#include "oracles/bullet/shapes.h"

namespace touchstone::bullet_adapter {
namespace {

using BroadPhasePtr = std::unique_ptr<btBroadphaseInterface>;

// AABBs outside the world are clamped to it. 16384 is the default maximum of the version with 16-bit handles.
const btVector3 world_lo(-1000, -1000, -1000), world_hi(1000, 1000, 1000);
constexpr int most_proxies = 16384;

struct Row {
  const char *name, *settings;
  BroadPhasePtr (*make)();
};
constexpr Row rows[] = {
    {"dbvt", "btDbvtBroadphase", [] { return BroadPhasePtr(std::make_unique<btDbvtBroadphase>()); }},
    {"axis-sweep", "btAxisSweep3, world of ±1000",
     [] { return BroadPhasePtr(std::make_unique<btAxisSweep3>(world_lo, world_hi, most_proxies)); }},
    {"axis-sweep-32", "bt32BitAxisSweep3, world of ±1000",
     [] { return BroadPhasePtr(std::make_unique<bt32BitAxisSweep3>(world_lo, world_hi, most_proxies)); }},
    {"simple", "btSimpleBroadphase",
     [] { return BroadPhasePtr(std::make_unique<btSimpleBroadphase>(most_proxies)); }},
};

class Run {
 public:
  /// `margin`: every AABB is widened by half of it.
  Run(const ts_scene& scene, const std::vector<std::unique_ptr<Shape>>& shapes, btDispatcher& dispatcher,
      BroadPhasePtr phase, double margin)
      : scene_(scene),
        margin_(margin),
        shapes_(shapes),
        dispatcher_(dispatcher),
        phase_(std::move(phase)),
        proxies_(scene.body_count) {
    for (std::size_t i = 0; i < numbers_.size(); ++i) numbers_[i] = static_cast<int>(i);
  }
  ~Run() {
    for (btBroadphaseProxy* p : proxies_)
      if (p) phase_->destroyProxy(p, &dispatcher_);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void apply(const ts_step& step) {
    btBroadphaseProxy*& proxy = proxies_[static_cast<std::size_t>(step.body)];
    if (step.op == TS_REMOVE) {
      phase_->destroyProxy(proxy, &dispatcher_);
      proxy = nullptr;
      return;
    }
    btVector3 lo, hi;
    box_of(step, lo, hi);
    if (margin_ > 0) widen(lo, hi);
    if (step.op == TS_MOVE) return phase_->setAabb(proxy, lo, hi, &dispatcher_);
    const bool fixed = scene_.bodies[step.body].is_static;
    const int group = fixed ? btBroadphaseProxy::StaticFilter : btBroadphaseProxy::DefaultFilter;
    const int mask = btBroadphaseProxy::AllFilter ^ (fixed ? btBroadphaseProxy::StaticFilter : 0);
    proxy = phase_->createProxy(lo, hi, BOX_SHAPE_PROXYTYPE, &numbers_[static_cast<std::size_t>(step.body)],
                                group, mask, &dispatcher_);
    if (!proxy) throw kit::Unsupported("no room for another proxy");
  }

  template <class Pair>
  void query(Pair&& pair) {
    phase_->calculateOverlappingPairs(&dispatcher_);
    const btBroadphasePairArray& pairs = phase_->getOverlappingPairCache()->getOverlappingPairArray();
    const auto number = [](const btBroadphaseProxy* p) {
      return *static_cast<const int*>(p->m_clientObject);
    };
    for (int i = 0; i < pairs.size(); ++i) pair(number(pairs[i].m_pProxy0), number(pairs[i].m_pProxy1));
  }

 private:
  // Outward by half the margin and by the roundings of the sum and of the margin.
  void widen(btVector3& lo, btVector3& hi) const {
    const btScalar most = std::numeric_limits<btScalar>::infinity();
    const btScalar by = std::nextafter(static_cast<btScalar>(margin_ / 2), most);
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::nextafter(lo[k] - by, -most);
      hi[k] = std::nextafter(hi[k] + by, most);
    }
  }
  // The AABB of an axis-aligned box is computed directly, as a user with AABBs would: btBoxShape::getAabb
  // rounds once more because of its margin. A rotation by a third of a turn about the diagonal also keeps a
  // box axis-aligned.
  void box_of(const ts_step& step, btVector3& lo, btVector3& hi) const {
    const std::int32_t number = scene_.bodies[step.body].shape;
    const ts_shape& asked = scene_.shapes[number];
    const double* q = step.pose.rotation;
    const bool thirds = q[0] == q[1] && q[1] == q[2] && (q[3] == q[0] || q[3] == -q[0]);
    if (asked.kind != TS_BOX || (!thirds && (q[0] != 0 || q[1] != 0 || q[2] != 0)))
      return shapes_[static_cast<std::size_t>(number)]->shape->getAabb(
          make_transform(kit::pose_of(step.pose)), lo, hi);
    const int shift = !thirds || q[0] == 0 ? 0 : q[3] == q[0] ? 2 : 1;
    for (int k = 0; k < 3; ++k) {
      const auto t = static_cast<btScalar>(step.pose.translation[k]),
                 h = static_cast<btScalar>(asked.size[(k + shift) % 3]);
      lo[k] = t - h;
      hi[k] = t + h;
    }
  }

  const ts_scene& scene_;
  double margin_;
  const std::vector<std::unique_ptr<Shape>>& shapes_;
  btDispatcher& dispatcher_;
  BroadPhasePtr phase_;
  std::vector<btBroadphaseProxy*> proxies_;
  std::vector<int> numbers_ =
      std::vector<int>(scene_.body_count);  // a proxy without a client object is skipped
};

class Engine {
 public:
  static constexpr ts_question later_questions[] = {TS_CANDIDATES_WITHIN};
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> all;
    const std::string prefix = is_double ? "bullet-f64-" : "bullet-f32-";
    const std::string version =
        std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
    for (const Row& r : rows)
      all.push_back(
          {prefix + r.name, "Bullet", version,
           std::string(r.settings) + " alone; upright boxes as t ± h, others by getAabb with margin 0",
           unit_roundoff, kit::oracle_tau_factor, "BulletCollision/BroadphaseCollision: no tolerance"});
    return all;
  }
  explicit Engine(unsigned index) : row_(rows[index]), dispatcher_(&configuration_) {}

  void load(const ts_scene& scene, const ts_received&) {
    unload();
    for (std::size_t i = 0; i < scene.shape_count; ++i) {
      shapes_.push_back(make_shape(scene.shapes[i], 0));
      if (!shapes_.back()->shape) kit::no_such_shape("Bullet");
    }
    scene_ = &scene;
    filter_ = kit::PairFilter(scene);
  }
  void unload() {
    shapes_.clear();
    scene_ = nullptr;
  }

  void ask(ts_question question, int, int, ts_answer&, const ts_sink& sink) {
    if (question != TS_CANDIDATES && question != TS_CANDIDATES_WITHIN)
      throw kit::Unsupported("a broad phase only");
    const double margin = question == TS_CANDIDATES_WITHIN ? scene_->margin : 0;
    Run run(*scene_, shapes_, dispatcher_, row_.make(), margin);
    kit::run_script(
        *scene_, [&](const ts_step& step) { run.apply(step); },
        [&](int k) {
          run.query([&](int a, int b) {
            if (!filter_.drops(a, b)) sink.pair(sink.ctx, k, a, b);
          });
        });
  }

 private:
  const Row& row_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  const ts_scene* scene_ = nullptr;
  std::vector<std::unique_ptr<Shape>> shapes_;
  kit::PairFilter filter_;
};

}  // namespace
}  // namespace touchstone::bullet_adapter

TS_PLUGIN(touchstone::bullet_adapter::Engine)
