#include "oracles/bullet/world.h"

#include <map>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::bullet_adapter {

Assembly::Assembly(const ts_scene& scene, Objects& objects) : bodies_(static_cast<int>(scene.body_count)) {
  std::map<int, Compound*> of_group;
  std::map<int, int> convex_in;
  const auto is_part = [&](int body) {
    return scene.bodies[body].group >= 0 &&
           objects[static_cast<std::size_t>(body)]->getCollisionShape()->isConvex();
  };
  for (int body = 0; body < bodies_; ++body)
    if (is_part(body)) ++convex_in[scene.bodies[body].group];
  for (int body = 0; body < bodies_; ++body) {
    btCollisionObject& alone = *objects[static_cast<std::size_t>(body)];
    if (!is_part(body) || convex_in[scene.bodies[body].group] < 2) {
      all_.push_back(&alone);
      continue;
    }
    Compound*& compound = of_group[scene.bodies[body].group];
    if (!compound) {
      compounds_.push_back(std::make_unique<Compound>());
      compound = compounds_.back().get();
      compound->object.setWorldTransform(alone.getWorldTransform());
      compound->object.setCollisionShape(&compound->shape);
      compound->object.setUserIndex(bodies_ + static_cast<int>(compounds_.size()) - 1);
      all_.push_back(&compound->object);
    }
    const btTransform place = compound->object.getWorldTransform().inverse() * alone.getWorldTransform();
    compound->shape.addChildShape(place, alone.getCollisionShape());
    compound->bodies.push_back(body);
  }
}

int Assembly::body_of(const btCollisionObject& object, int index) const {
  const int number = object.getUserIndex();
  if (number < bodies_) return number;
  return compounds_[static_cast<std::size_t>(number - bodies_)]->bodies.at(static_cast<std::size_t>(index));
}

void for_each_cached_pair(btCollisionWorld& world, const std::function<void(int, int)>& pair) {
  const btBroadphasePairArray& pairs = world.getPairCache()->getOverlappingPairArray();
  const auto index = [](const btBroadphaseProxy* p) {
    return static_cast<const btCollisionObject*>(p->m_clientObject)->getUserIndex();
  };
  for (int i = 0; i < pairs.size(); ++i) pair(index(pairs[i].m_pProxy0), index(pairs[i].m_pProxy1));
}

void run_script(const ts_scene& scene, Objects& objects, World& world,
                const std::function<void(int, int, int)>& pair) {
  const auto apply = [&](const ts_step& step) {
    btCollisionObject* const o = objects[static_cast<std::size_t>(step.body)].get();
    if (step.op != TS_REMOVE) o->setWorldTransform(make_transform(kit::pose_of(step.pose)));
    if (step.op == TS_INSERT) world->addCollisionObject(o);
    if (step.op == TS_REMOVE) world->removeCollisionObject(o);
  };
  kit::run_script(scene, apply, [&](int k) {
    world->updateAabbs();
    world->computeOverlappingPairs();
    for_each_cached_pair(*world, [&](int a, int b) { pair(k, a, b); });
  });
}

}  // namespace touchstone::bullet_adapter
