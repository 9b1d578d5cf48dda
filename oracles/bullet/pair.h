// Bullet's pair queries: contact points by the query path or the simulation path, and the convex sweep.
#pragma once

#include <optional>
#include <vector>

#include "oracles/bullet/world.h"

namespace touchstone::bullet_adapter {

/// One contact or closest point. Bullet's normals point from B to A and are reversed here.
struct Point {
  Vec3 on_a, on_b, normal_ab;
  double distance;       // < 0: penetration
  int index_a, index_b;  // of a compound, the number of the child shape
};

/// btCollisionWorld::contactPairTest, which uses the closest-point algorithms (GJK and EPA for most pairs).
/// `threshold`: m_closestDistanceThreshold, the largest distance at which points are reported.
std::vector<Point> query_points(btCollisionWorld& world, btCollisionObject& a, btCollisionObject& b,
                                btScalar threshold);

/// All contact points between two bodies in the world's manifolds.
std::vector<Point> manifold_points(const btPersistentManifold& manifold, const btCollisionObject& a);

/// Runs performDiscreteCollisionDetection in a fresh world with the two bodies, and reads back the manifolds.
std::vector<Point> simulated_points(btDefaultCollisionConfiguration& configuration, btCollisionObject& a,
                                    btCollisionObject& b);

/// The point with the smallest distance, if any.
const Point* deepest(const std::vector<Point>& points);

/// btCollisionWorld::convexSweepTest of `mover` against a world that contains only `target`;
/// `allowed_penetration` is its last argument.
std::optional<double> sweep(btDefaultCollisionConfiguration& configuration, const btConvexShape& mover,
                            const btTransform& from, const btTransform& to, btCollisionObject& target,
                            double allowed_penetration);

struct RayHit {
  double part;  // of the way from start to end
  Vec3 normal;
};
/// btCollisionWorld::rayTestSingle against one body, as rayTest does for each that the ray's box meets, with
/// kF_UseGjkConvexCastRaytest: the default for convex shapes is documented as approximate, without a bound.
std::optional<RayHit> cast_ray(btCollisionObject& target, const Vec3& start, const Vec3& end);

}  // namespace touchstone::bullet_adapter
