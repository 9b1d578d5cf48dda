// Exact statements about single points of bodies.
#pragma once

#include <optional>
#include <vector>

#include "core/math/aabb.h"
#include "oracles/referee/referee.h"

namespace touchstone::referee {

// Decides exactly, in 512-bit integers, whether a point is in a body.

/// nullopt: the numbers are too long, or the body is a mesh, a half-space, placed by an affine map, or a cone
/// or ellipsoid without interior.
std::optional<bool> contains_short(const Placed& body, const Vec3& point_w);

/// What of a body can hold a point, so that the checker need not look at the rest: the triangles of a mesh
/// whose boxes hold it; any other body as a whole.
class Holder {
 public:
  explicit Holder(const Placed& p);
  /// For the exact point of which `rounded` is within an ulp, until the next call; nullopt: nothing of it.
  std::optional<Placed> part_at(const Vec3& rounded);

 private:
  Placed whole_;
  std::vector<Aabb> boxes_;  // of the triangles, rounded outward; empty for any other body
  Shape part_;
};
/// Whether the checker finds the point of a common_point in both bodies.
bool is_common_point(const Certificate& c, Holder& a, Holder& b);

// The last level for pairs with a curved body whose bracket contains 0: exact contact. Bodies that touch by
// construction touch at points with simple coordinates; such a point is guessed from the rounded witness and
// accepted only when the checker finds it in both bodies.

/// A common_point, or kind none when no guess is accepted.
Certificate guess_common_point(const std::array<Vec3, 2>& witness, const Placed& a, const Placed& b,
                               int& level);

}  // namespace touchstone::referee
