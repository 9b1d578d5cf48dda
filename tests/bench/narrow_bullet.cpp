// Bullet, margin 0: boxes against boxes by the box-box detector, everything else by GJK with EPA, called
// directly. One source for both precisions.
#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

#include "tests/bench/narrow_cases.h"

namespace touchstone::bench {
namespace {

btScalar scalar(double x) { return static_cast<btScalar>(x); }
btVector3 vector(const Vec3& v) { return {scalar(v.x()), scalar(v.y()), scalar(v.z())}; }

std::unique_ptr<btConvexShape> make_shape(const Shape& s) {
  std::unique_ptr<btConvexShape> r;
  if (const auto* x = std::get_if<Sphere>(&s)) return std::make_unique<btSphereShape>(scalar(x->radius));
  if (const auto* x = std::get_if<Capsule>(&s))
    return std::make_unique<btCapsuleShapeZ>(scalar(x->radius), scalar(2 * x->half_height));
  if (const auto* x = std::get_if<Box>(&s)) r = std::make_unique<btBoxShape>(vector(x->half_extents));
  if (const auto* x = std::get_if<Cylinder>(&s))
    r = std::make_unique<btCylinderShapeZ>(vector({x->radius, x->radius, x->half_height}));
  if (const auto* x = std::get_if<Cone>(&s))
    r = std::make_unique<btConeShapeZ>(scalar(x->radius), scalar(2 * x->half_height));
  if (const auto* x = std::get_if<Hull>(&s)) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& v : x->vertices) hull->addPoint(vector(v), false);
    hull->recalcLocalAabb();
    r = std::move(hull);
  }
  if (r) r->setMargin(0);
  return r;
}

btTransform make_transform(const Pose& pose) {
  const Quat q = normalized(pose.rotation);
  return btTransform(btQuaternion(scalar(q.x), scalar(q.y), scalar(q.z), scalar(q.w)),
                     vector(pose.translation));
}

struct Deepest final : btDiscreteCollisionDetectorInterface::Result {
  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3& normal_on_b, const btVector3&, btScalar d) override {
    ++points;
    if (!(d < distance)) return;
    distance = d;
    normal = normal_on_b;
  }
  btScalar distance = BT_LARGE_FLOAT;
  btVector3 normal;
  int points = 0;
};

class Bullet final : public NarrowContestant {
 public:
  Bullet(Task task, const std::vector<PairCase>& cases) : task_(task) {
    for (const PairCase& c : cases)
      pairs_.push_back(
          {make_shape(c.a), make_shape(c.b), make_transform(c.pose_a), make_transform(c.pose_b)});
  }
  void ask(std::size_t i, Found& out) override {
    const Pair& p = pairs_[i];
    btDiscreteCollisionDetectorInterface::ClosestPointInput input;
    input.m_transformA = p.at_a;
    input.m_transformB = p.at_b;
    Deepest r;
    const bool boxes =
        p.a->getShapeType() == BOX_SHAPE_PROXYTYPE && p.b->getShapeType() == BOX_SHAPE_PROXYTYPE;
    if (boxes && task_ != Task::distance) {
      btBoxBoxDetector detector(static_cast<const btBoxShape*>(p.a.get()),
                                static_cast<const btBoxShape*>(p.b.get()));
      input.m_maximumDistanceSquared = 0;
      detector.getClosestPoints(input, r, nullptr);
    } else {
      simplex_.reset();
      btGjkPairDetector detector(p.a.get(), p.b.get(), &simplex_, &epa_);
      detector.getClosestPoints(input, r, nullptr);
    }
    out.overlap = r.points > 0 && r.distance <= 0;
    out.points = r.points;
    if (r.points == 0) return;
    out.gap = static_cast<double>(r.distance);
    out.normal = -Vec3(r.normal.x(), r.normal.y(), r.normal.z());
  }

 private:
  struct Pair {
    std::unique_ptr<btConvexShape> a, b;
    btTransform at_a, at_b;
  };
  Task task_;
  std::vector<Pair> pairs_;
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver epa_;
};

}  // namespace

NarrowContestantPtr make_narrow_bullet(Task task, const PairKind& kind, const std::vector<PairCase>& cases) {
  if (kind.a == ShapeKind::ellipsoid || kind.b == ShapeKind::ellipsoid) return nullptr;
  return std::make_unique<Bullet>(task, cases);
}

}  // namespace touchstone::bench
