#pragma once

#include "Jolt/Physics/Collision/Shape/Shape.h"

namespace JPH {

class SphereShapeSettings : public ShapeSettings {
 public:
  explicit SphereShapeSettings(float radius) : ShapeSettings(radius) {}
};

}  // namespace JPH
