// Solid meshes. The rest of the referee knows convex bodies, half-spaces and surfaces; the public functions
// put here, in the place of a solid, the hull of its vertices, where that is the same (a convex solid; any
// solid beside a half-space), or else its surface, and add what its inside changes.
#pragma once

#include <optional>

#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/referee.h"

namespace touchstone::referee {

inline bool is_solid(const Placed& p) { return std::holds_alternative<SolidMesh>(*p.shape); }
inline bool has_solid(const Placed& a, const Placed& b) { return is_solid(a) || is_solid(b); }

/// A body whose solid mesh is replaced by its surface. Other bodies are as they were.
class AsSurface {
 public:
  explicit AsSurface(const Placed& p);
  AsSurface(const AsSurface&) = delete;
  AsSurface& operator=(const AsSurface&) = delete;
  const Placed& operator*() const { return placed_; }

 private:
  Shape own_;
  Placed placed_;
};

/// A pair with each solid replaced by its hull where that is the same set, or serves as well: a convex solid,
/// or a solid beside a half-space.
class AsHulls {
 public:
  AsHulls(const Placed& a, const Placed& b);
  AsHulls(const AsHulls&) = delete;
  AsHulls& operator=(const AsHulls&) = delete;
  const Placed& a() const { return a_; }
  const Placed& b() const { return b_; }
  /// No solid is left.
  bool are_plain() const { return !has_solid(a_, b_); }

 private:
  Shape own_a_, own_b_;
  Placed a_, b_;
};

/// Whether the region inside a valid surface is convex: the surface is a sphere, and no edge is reflex.
/// Exact.
bool is_convex_inside(const TriangleMesh& surface);

/// Whether the point is in the solid, for a point that is not on its surface; on it, either answer. Exact.
bool is_inside(const Placed& solid, const Rational3& point_w);

/// A point of one body that is in the other, for bodies with a solid whose surfaces do not meet; nullopt:
/// they are apart.
std::optional<Rational3> point_inside(const Placed& a, const Placed& b);

/// Points of the solid from which its whole surface is seen: the hull of these and of any triangle is in the
/// solid. Exact. None for a solid with a hole or a cavity, and perhaps none where only a small part of it
/// sees all.
std::vector<Vec3> kernel_points(const TriangleMesh& surface);

// The depth of a pair of which one body is a solid that is not convex, the other another solid or convex, and
// that overlaps.

struct SolidDepth {
  Bracket depth;
  Vec3 normal = Vec3::Zero();  // a direction in which moving B by depth.hi separates them
};
SolidDepth depth_of_solids(const Placed& a, const Placed& b, std::span<const Vec3> hint_directions);

/// Proven: no motion of B shorter than this separates them. 0 where nothing is known. Either may be a
/// surface.
double depth_at_least(const Placed& a, const Placed& b);

/// The least s >= 0 so that B moved by s along n/|n| is clear of A: hi is shown by a place where it is, lo by
/// balls and convex parts inside both at every place before.
Bracket way_along(const Placed& a, const Placed& b, const Vec3& n);

}  // namespace touchstone::referee
