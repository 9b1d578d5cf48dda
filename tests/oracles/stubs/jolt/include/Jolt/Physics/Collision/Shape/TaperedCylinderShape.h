#pragma once

#include "Jolt/Physics/Collision/Shape/Shape.h"

namespace JPH {

class TaperedCylinderShapeSettings : public ShapeSettings {
 public:
  TaperedCylinderShapeSettings(float, float, float, float) {}
};

}  // namespace JPH
