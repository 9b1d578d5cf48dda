// Bullet's broad phases: the tree (btDbvtBroadphase) and the incremental sweep (bt32BitAxisSweep3).
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <algorithm>

#include "tests/bench/broad_scenes.h"

namespace touchstone::bench {
namespace {

btVector3 corner(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

class Bullet final : public Contestant {
 public:
  explicit Bullet(bool sweep) : sweep_(sweep) {}
  ~Bullet() override {
    for (btBroadphaseProxy* p : proxies_) phase_->destroyProxy(p, nullptr);
  }
  void start(const std::vector<Aabb>& boxes) override {
    if (sweep_) {
      Aabb world;
      for (const Aabb& b : boxes) world.extend(b);
      const Vec3 margin = (world.hi - world.lo) / 4;
      phase_ = std::make_unique<bt32BitAxisSweep3>(corner(world.lo - margin), corner(world.hi + margin),
                                                   static_cast<unsigned>(boxes.size()) + 1, nullptr, true);
    } else {
      phase_ = std::make_unique<btDbvtBroadphase>();
    }
    boxes_ = boxes;
    ids_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      ids_[i] = static_cast<int>(i);
      proxies_.push_back(
          phase_->createProxy(corner(boxes[i].lo), corner(boxes[i].hi), 0, &ids_[i], 1, 1, nullptr));
    }
    phase_->calculateOverlappingPairs(nullptr);
  }
  void frame(const std::vector<broad::BoxUpdate>& moves, std::vector<broad::IdPair>& out) override {
    for (const broad::BoxUpdate& m : moves) {
      const auto i = static_cast<std::size_t>(m.id);
      boxes_[i] = m.box;
      phase_->setAabb(proxies_[i], corner(m.box.lo), corner(m.box.hi), nullptr);
    }
    phase_->calculateOverlappingPairs(nullptr);
    out.clear();
    const btBroadphasePairArray& all = phase_->getOverlappingPairCache()->getOverlappingPairArray();
    reported_ = static_cast<std::size_t>(all.size());
    for (int k = 0; k < all.size(); ++k) {
      if (all[k].m_pProxy0 == nullptr) continue;
      const int a = *static_cast<int*>(all[k].m_pProxy0->m_clientObject),
                b = *static_cast<int*>(all[k].m_pProxy1->m_clientObject);
      if (overlaps(boxes_[static_cast<std::size_t>(a)], boxes_[static_cast<std::size_t>(b)]))
        out.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::size_t reported() const override { return reported_; }

 private:
  bool sweep_;
  std::size_t reported_ = 0;
  std::unique_ptr<btBroadphaseInterface> phase_;
  std::vector<btBroadphaseProxy*> proxies_;
  std::vector<int> ids_;
  std::vector<Aabb> boxes_;
};

}  // namespace

std::unique_ptr<Contestant> make_bullet_dbvt() { return std::make_unique<Bullet>(false); }
std::unique_ptr<Contestant> make_bullet_sweep() { return std::make_unique<Bullet>(true); }

}  // namespace touchstone::bench
