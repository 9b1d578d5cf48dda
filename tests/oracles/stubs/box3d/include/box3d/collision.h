// Stand-in for Box3D's collision.h: spheres and capsules against spheres; everything else finds nothing.
#pragma once

#include <cmath>
#include <cstdint>

#include "constants.h"

struct b3Vec3 {
  float x, y, z;
};
struct b3Quat {
  b3Vec3 v;
  float s;
};
struct b3Transform {
  b3Vec3 p;
  b3Quat q;
};
using b3Pos = b3Vec3;
using b3WorldTransform = b3Transform;

struct b3Version {
  int major, minor, revision;
};
inline b3Version b3GetVersion() { return {0, 0, 1}; }

namespace stub {

inline b3Vec3 add(b3Vec3 a, b3Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline b3Vec3 times(float s, b3Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline b3Vec3 minus(b3Vec3 a, b3Vec3 b) { return add(a, times(-1, b)); }
inline float dot(b3Vec3 a, b3Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline b3Vec3 cross(b3Vec3 a, b3Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(b3Vec3 a) { return std::sqrt(dot(a, a)); }
inline b3Vec3 rotated(b3Quat q, b3Vec3 p) {
  const b3Vec3 t = times(2, cross(q.v, p));
  return add(add(p, times(q.s, t)), cross(q.v, t));
}
inline b3Quat conjugate(b3Quat q) { return {times(-1, q.v), q.s}; }
inline b3Quat product(b3Quat a, b3Quat b) {
  return {add(add(times(a.s, b.v), times(b.s, a.v)), cross(a.v, b.v)), a.s * b.s - dot(a.v, b.v)};
}
inline b3Vec3 moved(b3Transform t, b3Vec3 p) { return add(t.p, rotated(t.q, p)); }

}  // namespace stub

inline b3Transform b3InvMulWorldTransforms(b3WorldTransform a, b3WorldTransform b) {
  const b3Quat back = stub::conjugate(a.q);
  return {stub::rotated(back, stub::minus(b.p, a.p)), stub::product(back, b.q)};
}

struct b3Sphere {
  b3Vec3 center;
  float radius;
};
struct b3Capsule {
  b3Vec3 center1, center2;
  float radius;
};
struct b3HullData {
  std::int32_t vertexCount;
  const b3Vec3* points;
};
struct b3BoxHull {
  b3HullData base;
  b3Vec3 boxPoints[8];
};
inline const b3Vec3* b3GetHullPoints(const b3HullData* hull) { return hull->points; }
inline b3BoxHull b3MakeBoxHull(float x, float y, float z) { return {{0, nullptr}, {{x, y, z}}}; }
inline b3HullData* b3CreateHull(const b3Vec3*, int, int) { return nullptr; }
inline void b3DestroyHull(b3HullData* hull) { delete hull; }

struct b3ShapeProxy {
  const b3Vec3* points;
  int count;
  float radius;
};
struct b3SimplexCache {
  std::uint16_t count;
};
struct b3Simplex {};
struct b3DistanceInput {
  b3ShapeProxy proxyA, proxyB;
  b3Transform transform;
  bool useRadii;
};
struct b3DistanceOutput {
  b3Vec3 pointA, pointB, normal;
  float distance;
};
/// Of points and their radii, in frame A.
inline b3DistanceOutput b3ShapeDistance(const b3DistanceInput* in, b3SimplexCache*, b3Simplex*, int) {
  const b3Vec3 a = in->proxyA.points[0], b = stub::moved(in->transform, in->proxyB.points[0]);
  const b3Vec3 between = stub::minus(b, a);
  const float apart = stub::length(between);
  const b3Vec3 n = stub::times(1 / apart, between);
  const float gap = apart - in->proxyA.radius - in->proxyB.radius;
  return {stub::add(a, stub::times(in->proxyA.radius, n)), stub::minus(b, stub::times(in->proxyB.radius, n)),
          n, gap > 0 ? gap : 0};
}
inline bool b3OverlapSphere(const b3Sphere* s, b3Transform pose, const b3ShapeProxy* proxy) {
  const b3Vec3 between = stub::minus(proxy->points[0], stub::moved(pose, s->center));
  return stub::length(between) - s->radius - proxy->radius < B3_OVERLAP_SLOP;
}
inline bool b3OverlapCapsule(const b3Capsule*, b3Transform, const b3ShapeProxy*) { return false; }
inline bool b3OverlapHull(const b3HullData*, b3Transform, const b3ShapeProxy*) { return false; }

struct b3LocalManifoldPoint {
  b3Vec3 point;
  float separation;
};
struct b3LocalManifold {
  b3Vec3 normal;
  b3LocalManifoldPoint* points;
  int pointCount;
};
struct b3SATCache {
  float separation;
};
inline void b3CollideCapsuleAndSphere(b3LocalManifold* m, int, const b3Capsule* c, const b3Sphere* s,
                                      b3Transform pose) {
  const b3Vec3 axis = stub::minus(c->center2, c->center1), center = stub::moved(pose, s->center);
  const float square = stub::dot(axis, axis);
  float t = square > 0 ? stub::dot(stub::minus(center, c->center1), axis) / square : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  const b3Vec3 nearest = stub::add(c->center1, stub::times(t, axis)), between = stub::minus(center, nearest);
  const float apart = stub::length(between);
  m->normal = stub::times(1 / apart, between);
  m->pointCount = 1;
  m->points[0].separation = apart - c->radius - s->radius;
  m->points[0].point = stub::add(nearest, stub::times((apart + c->radius - s->radius) / 2, m->normal));
}
inline void b3CollideSpheres(b3LocalManifold* m, int n, const b3Sphere* a, const b3Sphere* b,
                             b3Transform pose) {
  const b3Capsule point{a->center, a->center, a->radius};
  b3CollideCapsuleAndSphere(m, n, &point, b, pose);
}
inline void b3CollideCapsules(b3LocalManifold* m, int, const b3Capsule*, const b3Capsule*, b3Transform) {
  m->pointCount = 0;
}
inline void b3CollideHullAndSphere(b3LocalManifold* m, int, const b3HullData*, const b3Sphere*, b3Transform,
                                   b3SimplexCache*) {
  m->pointCount = 0;
}
inline void b3CollideHullAndCapsule(b3LocalManifold* m, int, const b3HullData*, const b3Capsule*, b3Transform,
                                    b3SimplexCache*) {
  m->pointCount = 0;
}
inline void b3CollideHulls(b3LocalManifold* m, int, const b3HullData*, const b3HullData*, b3Transform,
                           b3SATCache*) {
  m->pointCount = 0;
}

struct b3Sweep {
  b3Vec3 localCenter, c1, c2;
  b3Quat q1, q2;
};
struct b3TOIInput {
  b3ShapeProxy proxyA, proxyB;
  b3Sweep sweepA, sweepB;
  float maxFraction;
};
enum b3TOIState {
  b3_toiStateUnknown,
  b3_toiStateFailed,
  b3_toiStateOverlapped,
  b3_toiStateHit,
  b3_toiStateSeparated
};
struct b3TOIOutput {
  b3TOIState state;
  float fraction;
};
/// Of points and their radii: the first time at which they are B3_LINEAR_SLOP deep, by the quadratic
/// equation.
inline b3TOIOutput b3TimeOfImpact(const b3TOIInput* in) {
  const auto at = [](const b3ShapeProxy& p, const b3Sweep& s) {
    return stub::add(s.c1, stub::rotated(s.q1, p.points[0]));
  };
  const b3Vec3 p = stub::minus(at(in->proxyB, in->sweepB), at(in->proxyA, in->sweepA));
  const b3Vec3 v =
      stub::minus(stub::minus(in->sweepB.c2, in->sweepB.c1), stub::minus(in->sweepA.c2, in->sweepA.c1));
  const float r = in->proxyA.radius + in->proxyB.radius - B3_LINEAR_SLOP;
  const float a = stub::dot(v, v), b = stub::dot(p, v), c = stub::dot(p, p) - r * r;
  if (c <= 0) return {b3_toiStateHit, 0};
  const float root = b * b - a * c;
  if (a == 0 || b >= 0 || root < 0) return {b3_toiStateSeparated, in->maxFraction};
  const float t = (-b - std::sqrt(root)) / a;
  return t <= in->maxFraction ? b3TOIOutput{b3_toiStateHit, t}
                              : b3TOIOutput{b3_toiStateSeparated, in->maxFraction};
}
