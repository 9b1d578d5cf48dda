#pragma once

#include "Jolt/Jolt.h"
#include "Jolt/Physics/PhysicsSettings.h"

namespace JPH {

class Shape {
 public:
  explicit Shape(float radius) : radius(radius) {}
  Vec3 GetCenterOfMass() const { return Vec3::sZero(); }
  float radius;  // < 0: not a sphere
};

class ShapeSettings {
 public:
  class ShapeResult {
   public:
    explicit ShapeResult(float radius) : radius_(radius) {}
    bool HasError() const { return radius_ < 0; }
    std::string GetError() const { return "the stand-in knows spheres only"; }
    RefConst<Shape> Get() const { return {std::make_shared<const Shape>(radius_)}; }

   private:
    float radius_;
  };
  void SetEmbedded() const {}
  ShapeResult Create() const { return ShapeResult(radius_); }

 protected:
  explicit ShapeSettings(float radius = -1) : radius_(radius) {}

 private:
  float radius_;
};

}  // namespace JPH
