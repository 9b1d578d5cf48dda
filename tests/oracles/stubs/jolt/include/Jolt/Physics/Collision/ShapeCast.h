#pragma once

#include "Jolt/Physics/Collision/CollideShape.h"

namespace JPH {

enum class EBackFaceMode { IgnoreBackFaces, CollideWithBackFaces };

struct ShapeCastSettings : CollideSettingsBase {
  void SetBackFaceMode(EBackFaceMode) {}
};
struct ShapeCastResult : CollideShapeResult {
  float mFraction = 0;
  float GetEarlyOutFraction() const { return mFraction; }
};
struct RShapeCast {
  RShapeCast(const Shape* shape, Vec3Arg, const RMat44& start, Vec3Arg direction)
      : shape(shape), start(start.GetTranslation()), direction(direction) {}
  const Shape* shape;
  Vec3 start, direction;
};

}  // namespace JPH
