// Random shapes of size about 1 (half extents 0.3 to 1.2) times `scale`.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/math/rng.h"
#include "core/shape/shape.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::fuzz {

Shape random_shape(Rng& rng, ShapeKind kind, double scale);

/// Cores that are neither a sphere nor a box nor a capsule, with a ball around them.
inline constexpr ShapeKind padded_kinds[] = {ShapeKind::padded_cylinder, ShapeKind::padded_cone,
                                             ShapeKind::padded_ellipsoid, ShapeKind::padded_hull};

/// The convex kinds that every engine is sent (engine_card.h).
inline constexpr auto common_convex_kinds = [] {
  constexpr int all = static_cast<int>(last_common_shape) + 1;
  constexpr auto convex = [](int k) { return is_convex(static_cast<ShapeKind>(k)); };
  constexpr std::size_t n = [&] {
    std::size_t count = 0;
    for (int k = 0; k < all; ++k) count += convex(k);
    return count;
  }();
  std::array<ShapeKind, n> kinds{};
  for (std::size_t k = 0, i = 0; i < n; ++k)
    if (convex(static_cast<int>(k))) kinds[i++] = static_cast<ShapeKind>(k);
  return kinds;
}();

/// While it lives, the kinds that this thread draws are among these, if they include a bounded convex one.
/// make_case() sets it from its arguments alone.
class OnlyKinds {
 public:
  explicit OnlyKinds(std::span<const ShapeKind> kinds);
  ~OnlyKinds();
  OnlyKinds(const OnlyKinds&) = delete;
  OnlyKinds& operator=(const OnlyKinds&) = delete;

 private:
  std::vector<ShapeKind> before_;
};
/// Whether the kind may be drawn.
bool may_draw(ShapeKind kind);

/// One of common_convex_kinds, or of the bounded convex ones of OnlyKinds, with equal probability. Later
/// kinds have families of their own, so that the cases of a seed remain what they were.
ShapeKind random_convex_kind(Rng& rng);

/// Support value max n·x over the shape in its body frame; +inf for a half-space unless n is its normal.
double support_value(const Shape& shape, const Vec3& n_local);

/// With vertices at distance 1 along each axis.
TriangleMesh octahedron();

/// Each triangle split into four. The new vertices stay in place, so that the four are coplanar, or are
/// projected to the unit sphere (`round`).
TriangleMesh divided(const TriangleMesh& m, bool round);

/// An octahedron, also divided and rounded; a star of random radii; a prism with an L for its base; a ring; a
/// box with a cavity; a box.
SolidMesh random_solid(Rng& rng, double scale);

}  // namespace touchstone::fuzz
