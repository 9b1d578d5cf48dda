#pragma once

#include "coal/collision_object.h"

namespace coal {

template <class Polygon>
class Convex : public CollisionGeometry {
 public:
  Convex(std::shared_ptr<std::vector<Vec3s>>, unsigned, std::shared_ptr<std::vector<Polygon>>, unsigned) {}
};

}  // namespace coal
