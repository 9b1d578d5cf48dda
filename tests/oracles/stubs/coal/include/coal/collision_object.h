// Stand-in for Coal: geometries, of which spheres can be asked about.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace coal {

using CoalScalar = double;
using Vec3s = Eigen::Matrix<CoalScalar, 3, 1>;
using Matrix3s = Eigen::Matrix<CoalScalar, 3, 3>;

class CollisionGeometry {
 public:
  virtual ~CollisionGeometry() = default;
  virtual void computeLocalAABB() {}
};

class Triangle {
 public:
  using index_type = std::size_t;
  Triangle(index_type a, index_type b, index_type c) : vertices_{a, b, c} {}

 private:
  std::array<index_type, 3> vertices_;
};

}  // namespace coal
