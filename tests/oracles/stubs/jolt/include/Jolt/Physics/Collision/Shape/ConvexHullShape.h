#pragma once

#include "Jolt/Physics/Collision/Shape/Shape.h"

namespace JPH {

class ConvexHullShapeSettings : public ShapeSettings {
 public:
  ConvexHullShapeSettings(const Vec3*, int, float) {}
  float mMaxErrorConvexRadius = 0.05F, mHullTolerance = 1e-3F;
};

}  // namespace JPH
