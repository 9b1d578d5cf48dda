#pragma once

#include "Jolt/Physics/Collision/Shape/Shape.h"

namespace JPH {

class CylinderShapeSettings : public ShapeSettings {
 public:
  CylinderShapeSettings(float, float, float) {}
};

}  // namespace JPH
