// Bullet's casts in double, margin 0, called directly: the sub-simplex cast for translations and the
// continuous one, which stops rotating at 45 degrees.
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

#include "tests/bench/impact_cases.h"

namespace touchstone::bench {
namespace {

btVector3 vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::unique_ptr<btConvexShape> make_shape(const Shape& s) {
  std::unique_ptr<btConvexShape> r;
  if (const auto* x = std::get_if<Sphere>(&s)) return std::make_unique<btSphereShape>(x->radius);
  if (const auto* x = std::get_if<Capsule>(&s))
    return std::make_unique<btCapsuleShapeZ>(x->radius, 2 * x->half_height);
  if (const auto* x = std::get_if<Box>(&s)) r = std::make_unique<btBoxShape>(vector(x->half_extents));
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
  return btTransform(btQuaternion(q.x, q.y, q.z, q.w), vector(pose.translation));
}

class Bullet final : public ImpactContestant {
 public:
  Bullet(bool continuous, const std::vector<MovingCase>& cases) : continuous_(continuous) {
    for (const MovingCase& c : cases)
      pairs_.push_back({make_shape(c.a), make_shape(c.b), make_transform(c.pose_a),
                        make_transform(pose_at(c.pose_a, c.motion_a, 1)), make_transform(c.pose_b),
                        make_transform(pose_at(c.pose_b, c.motion_b, 1))});
  }
  void ask(std::size_t i, FoundImpact& out) override {
    const Pair& p = pairs_[i];
    btConvexCast::CastResult r;
    r.m_fraction = 1;
    simplex_.reset();
    bool hit = false;
    if (continuous_) {
      btContinuousConvexCollision cast(p.a.get(), p.b.get(), &simplex_, &epa_);
      hit = cast.calcTimeOfImpact(p.a_from, p.a_to, p.b_from, p.b_to, r);
    } else {
      btSubsimplexConvexCast cast(p.a.get(), p.b.get(), &simplex_);
      hit = cast.calcTimeOfImpact(p.a_from, p.a_to, p.b_from, p.b_to, r);
    }
    out.t.reset();
    if (hit) out.t = r.m_fraction;
  }

 private:
  struct Pair {
    std::unique_ptr<btConvexShape> a, b;
    btTransform a_from, a_to, b_from, b_to;
  };
  bool continuous_;
  std::vector<Pair> pairs_;
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver epa_;
};

bool known(const MovingKind& k) {
  const auto is = [](ShapeKind s) {
    return s == ShapeKind::sphere || s == ShapeKind::capsule || s == ShapeKind::box || s == ShapeKind::hull;
  };
  return is(k.a) && is(k.b);
}

}  // namespace

ImpactContestantPtr make_impact_bullet_subsimplex(const MovingKind& kind, Course course,
                                                  const std::vector<MovingCase>& cases) {
  if (!known(kind) || (course != Course::translation && course != Course::graze)) return nullptr;
  return std::make_unique<Bullet>(false, cases);
}

ImpactContestantPtr make_impact_bullet_continuous(const MovingKind& kind, Course course,
                                                  const std::vector<MovingCase>& cases) {
  // Motions are given by end poses, so half a turn at most.
  if (!known(kind) || course == Course::spin) return nullptr;
  return std::make_unique<Bullet>(true, cases);
}

}  // namespace touchstone::bench
