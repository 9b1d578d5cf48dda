#pragma once

#include "Jolt/Physics/Collision/Shape/Shape.h"

namespace JPH {

class BoxShapeSettings : public ShapeSettings {
 public:
  BoxShapeSettings(Vec3Arg, float) {}
};

}  // namespace JPH
