#pragma once

#include "Jolt/Physics/Collision/CollisionCollectorImpl.h"

namespace JPH {

class TransformedShape {
 public:
  TransformedShape(const RVec3& position, const Quat&, const Shape* shape, const BodyID&)
      : position_(position), shape_(shape) {}

  /// Shape 1 is the argument. The penetration axis is not unit: its length is meaningless.
  void CollideShape(const Shape* shape, Vec3Arg, const RMat44& pose, const CollideShapeSettings& settings,
                    const RVec3&, CollideShapeCollector& found) const {
    const Vec3 from = pose.GetTranslation(), between = position_ - from;
    const float apart = between.Length(), depth = shape->radius + shape_->radius - apart;
    if (-depth > settings.mMaxSeparationDistance) return;
    const Vec3 n = between * (1 / apart);
    found.AddHit({from + n * shape->radius, position_ - n * shape_->radius, between, depth});
  }

  void CastShape(const RShapeCast& cast, const ShapeCastSettings&, const RVec3&,
                 CastShapeCollector& found) const {
    const Vec3 p = cast.start - position_, v = cast.direction;
    const float r = cast.shape->radius + shape_->radius;
    const float a = v.Dot(v), b = p.Dot(v), c = p.Dot(p) - r * r, root = b * b - a * c;
    ShapeCastResult hit;
    if (c > 0) {
      if (a == 0 || b >= 0 || root < 0) return;
      hit.mFraction = (-b - std::sqrt(root)) / a;
    }
    if (hit.mFraction <= 1) found.AddHit(hit);
  }

 private:
  Vec3 position_;
  const Shape* shape_;
};

}  // namespace JPH
