// Reduces a manifold to four points that keep its deepest point and most of its area: the deepest, the one
// farthest from it, and on either side of the line through both the one that spans the largest triangle with
// them. Ties go to the earlier point, so that equal depths select the same points in the next frame.
#include "core/narrow/narrow_phase.h"

namespace touchstone {

Manifold reduced(const ContactAnswer& contact) {
  const Manifold& all = contact.manifold;
  if (all.size() <= 4) return all;
  std::size_t deepest = 0, farthest = 0;
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i].depth > all[deepest].depth) deepest = i;
  const Vec3 from = all[deepest].position;
  const auto far = [&](std::size_t i) { return (all[i].position - from).squaredNorm(); };
  for (std::size_t i = 1; i < all.size(); ++i)
    if (far(i) > far(farthest)) farthest = i;
  const Vec3 side = contact.normal.cross(all[farthest].position - from);
  const auto off = [&](std::size_t i) { return side.dot(all[i].position - from); };
  std::size_t left = deepest, right = deepest;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (off(i) > off(left)) left = i;
    if (off(i) < off(right)) right = i;
  }
  Manifold r;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i == deepest || i == farthest || i == left || i == right) r.push_back(all[i]);
  return r;
}

}  // namespace touchstone
