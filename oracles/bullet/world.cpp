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
  int k = 0;
  for (std::size_t i = 0; i < scene.step_count; ++i) {
    const ts_step& step = scene.steps[i];
    btCollisionObject* const o =
        step.body >= 0 ? objects[static_cast<std::size_t>(step.body)].get() : nullptr;
    if (step.op == TS_INSERT || step.op == TS_MOVE)
      o->setWorldTransform(make_transform(kit::pose_of(step.pose)));
    if (step.op == TS_INSERT) world->addCollisionObject(o);
    if (step.op == TS_REMOVE) world->removeCollisionObject(o);
    if (step.op != TS_QUERY) continue;
    world->updateAabbs();
    world->computeOverlappingPairs();
    for_each_cached_pair(*world, [&](int a, int b) { pair(k, a, b); });
    ++k;
  }
}

}  // namespace touchstone::bullet_adapter
