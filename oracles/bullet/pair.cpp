#include "oracles/bullet/pair.h"

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

namespace touchstone::bullet_adapter {
namespace {

/// `swapped`: Bullet's body 0 is B.
Point point_of(const btManifoldPoint& p, bool swapped) {
  const Vec3 on_0 = vec3(p.getPositionWorldOnA()), on_1 = vec3(p.getPositionWorldOnB());
  const Vec3 normal_10 = vec3(p.m_normalWorldOnB);
  const auto distance = static_cast<double>(p.getDistance());
  if (swapped) return {on_1, on_0, normal_10, distance, p.m_index1, p.m_index0};
  return {on_0, on_1, -normal_10, distance, p.m_index0, p.m_index1};
}

struct Collect : btCollisionWorld::ContactResultCallback {
  explicit Collect(const btCollisionObject& a) : a_(a) {}
  btScalar addSingleResult(btManifoldPoint& p, const btCollisionObjectWrapper* zero, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    points.push_back(point_of(p, zero->getCollisionObject() != &a_));
    return 0;
  }
  std::vector<Point> points;

 private:
  const btCollisionObject& a_;
};

}  // namespace

std::vector<Point> query_points(btCollisionWorld& world, btCollisionObject& a, btCollisionObject& b,
                                btScalar threshold) {
  Collect collect(a);
  collect.m_closestDistanceThreshold = threshold;
  world.contactPairTest(&a, &b, collect);
  return std::move(collect.points);
}

std::vector<Point> manifold_points(const btPersistentManifold& manifold, const btCollisionObject& a) {
  std::vector<Point> points;
  for (int i = 0; i < manifold.getNumContacts(); ++i)
    points.push_back(point_of(manifold.getContactPoint(i), manifold.getBody0() != &a));
  return points;
}

std::vector<Point> simulated_points(btDefaultCollisionConfiguration& configuration, btCollisionObject& a,
                                    btCollisionObject& b) {
  World world(configuration);
  world->addCollisionObject(&a);
  world->addCollisionObject(&b);
  world->performDiscreteCollisionDetection();
  std::vector<Point> points;
  for (int i = 0; i < world->getDispatcher()->getNumManifolds(); ++i)
    for (const Point& p : manifold_points(*world->getDispatcher()->getManifoldByIndexInternal(i), a))
      points.push_back(p);
  world->removeCollisionObject(&a);
  world->removeCollisionObject(&b);
  return points;
}

const Point* deepest(const std::vector<Point>& points) {
  const Point* best = nullptr;
  for (const Point& p : points)
    if (!best || p.distance < best->distance) best = &p;
  return best;
}

std::optional<double> sweep(btDefaultCollisionConfiguration& configuration, const btConvexShape& mover,
                            const btTransform& from, const btTransform& to, btCollisionObject& target,
                            double allowed_penetration) {
  World world(configuration);
  world->addCollisionObject(&target);
  btCollisionWorld::ClosestConvexResultCallback closest(from.getOrigin(), to.getOrigin());
  world->convexSweepTest(&mover, from, to, closest, static_cast<btScalar>(allowed_penetration));
  world->removeCollisionObject(&target);
  if (!closest.hasHit()) return std::nullopt;
  return static_cast<double>(closest.m_closestHitFraction);
}

std::optional<RayHit> cast_ray(btCollisionObject& target, const Vec3& start, const Vec3& end) {
  const auto point = [](const Vec3& v) {
    return btVector3(static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()),
                     static_cast<btScalar>(v.z()));
  };
  const btTransform from(btQuaternion::getIdentity(), point(start)),
      to(btQuaternion::getIdentity(), point(end));
  btCollisionWorld::ClosestRayResultCallback closest(from.getOrigin(), to.getOrigin());
  closest.m_flags |= btTriangleRaycastCallback::kF_UseGjkConvexCastRaytest;
  btCollisionWorld::rayTestSingle(from, to, &target, target.getCollisionShape(), target.getWorldTransform(),
                                  closest);
  if (!closest.hasHit()) return std::nullopt;
  return RayHit{static_cast<double>(closest.m_closestHitFraction), vec3(closest.m_hitNormalWorld)};
}

}  // namespace touchstone::bullet_adapter
