#pragma once

#include "coal/collision_object.h"

namespace coal {

class Transform3s {
 public:
  Transform3s(const Matrix3s& rotation, const Vec3s& translation)
      : rotation_(rotation), translation_(translation) {}
  const Matrix3s& getRotation() const { return rotation_; }
  const Vec3s& getTranslation() const { return translation_; }

 private:
  Matrix3s rotation_;
  Vec3s translation_;
};

}  // namespace coal
