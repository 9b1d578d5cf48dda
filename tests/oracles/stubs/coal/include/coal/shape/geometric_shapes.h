#pragma once

#include "coal/collision_object.h"

namespace coal {

class Sphere : public CollisionGeometry {
 public:
  explicit Sphere(CoalScalar r) : radius(r) {}
  CoalScalar radius;
};
class Box : public CollisionGeometry {
 public:
  Box(CoalScalar, CoalScalar, CoalScalar) {}
};
class Capsule : public CollisionGeometry {
 public:
  Capsule(CoalScalar, CoalScalar) {}
};
class Cylinder : public CollisionGeometry {
 public:
  Cylinder(CoalScalar, CoalScalar) {}
};
class Cone : public CollisionGeometry {
 public:
  Cone(CoalScalar, CoalScalar) {}
};
class Ellipsoid : public CollisionGeometry {
 public:
  Ellipsoid(CoalScalar, CoalScalar, CoalScalar) {}
};
class Halfspace : public CollisionGeometry {
 public:
  Halfspace(CoalScalar a, CoalScalar b, CoalScalar c, CoalScalar offset) : n(a, b, c), d(offset / n.norm()) {
    n.normalize();
  }
  Vec3s n;
  CoalScalar d;
};

}  // namespace coal
