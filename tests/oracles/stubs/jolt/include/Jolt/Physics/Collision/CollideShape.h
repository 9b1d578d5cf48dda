#pragma once

#include "Jolt/Physics/Collision/Shape/Shape.h"

namespace JPH {

struct CollideShapeResult {
  Vec3 mContactPointOn1, mContactPointOn2, mPenetrationAxis;
  float mPenetrationDepth = 0;
  float GetEarlyOutFraction() const { return -mPenetrationDepth; }
};
struct CollideSettingsBase {
  float mCollisionTolerance = cDefaultCollisionTolerance,
        mPenetrationTolerance = cDefaultPenetrationTolerance;
};
struct CollideShapeSettings : CollideSettingsBase {
  float mMaxSeparationDistance = 0;
};

}  // namespace JPH
