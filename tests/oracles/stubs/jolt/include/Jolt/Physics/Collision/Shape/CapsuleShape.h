#pragma once

#include "Jolt/Physics/Collision/Shape/Shape.h"

namespace JPH {

class CapsuleShapeSettings : public ShapeSettings {
 public:
  CapsuleShapeSettings(float, float) {}
};

}  // namespace JPH
