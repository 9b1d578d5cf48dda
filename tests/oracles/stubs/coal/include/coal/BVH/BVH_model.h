#pragma once

#include "coal/collision_object.h"

namespace coal {

template <class Volume>
class BVHModel : public CollisionGeometry {
 public:
  int beginModel(unsigned, unsigned) { return 0; }
  int addSubModel(const std::vector<Vec3s>&, const std::vector<Triangle>&) { return 0; }
  int endModel() { return 0; }
};

}  // namespace coal
