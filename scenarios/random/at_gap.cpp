#include "scenarios/random/at_gap.h"

namespace touchstone::fuzz {

Scene at_gap(Rng& rng, Scene s, double gap) {
  const Vec3 n = placement_direction(rng, s);
  const double length = gap * mean_extent(s);
  place_along(rng, s, n, length, 0);
  if (is_convex(kind_of(s.shape_of(0))))
    s.bodies[1].pose.translation =
        s.bodies[0].pose.translation + (farthest_point(s, 0, n) - farthest_point(s, 1, -n) + n * length);
  return s;
}

}  // namespace touchstone::fuzz
