#include "oracles/bullet/world.h"

#include "oracles/abi/plugin_kit.h"

namespace touchstone::bullet_adapter {

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
