// Solid meshes. A convex one is answered as the hull of its vertices. Any other is its surface, a mesh, and
// its inside: bodies whose surfaces do not meet overlap if one contains a point of the other.
//
// Where a solid that is not convex overlaps a convex body or another solid, the reported depth is the least
// motion found that separates them: along each of some directions, which are the outward normals of the
// triangles that the bodies touch, the normals of least depth in these triangles, and that of the hulls, B is
// moved until it is clear. The motion does separate them; that no shorter one does is proven only as far as
// `regret_bound` says, by the depth in the deepest triangle.
#pragma once

#include <memory>
#include <optional>

#include "core/narrow/narrow_phase.h"

namespace touchstone {

/// What queries need of a solid mesh.
struct SolidParts {
  explicit SolidParts(const SolidMesh& solid);
  bool is_convex;
  Shape hull, surface;  // `surface` unless it is convex
  std::unique_ptr<const Collider> of_hull, of_surface;
  std::vector<Vec3> inner;  // a point inside for each connected part of the surface
};

namespace narrow {

bool has_solid(const ShapeRef& a, const ShapeRef& b);

// As the public functions without `solid_`. Precondition: has_solid(a, b).
OverlapAnswer solid_overlap(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic,
                            PairMemory* memory);
DistanceAnswer solid_distance(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic,
                              PairMemory* memory);
ContactAnswer solid_contact(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic,
                            PairMemory* memory);
Separation solid_separation(const PlacedShape& a, const PlacedShape& b);

/// The shapes that a query about a pair with a solid is about: a convex solid's hull, another solid's
/// surface, the hull of either beside a half-space, and the shape itself.
class SeenShape {
 public:
  SeenShape(const PlacedShape& p, const PlacedShape& other);
  const PlacedShape& seen() const { return seen_; }
  const PlacedShape& placed() const { return placed_; }
  /// Null unless the shape is seen as the surface of a solid.
  const SolidParts* inside() const { return inside_; }
  /// The hull of a solid, the shape itself otherwise.
  PlacedShape hull() const;
  /// The same elsewhere.
  SeenShape moved(const Vec3& by) const;

 private:
  PlacedShape placed_, seen_;
  std::shared_ptr<const SolidParts> own_;  // of a shape without a collider
  const SolidParts *parts_ = nullptr, *inside_ = nullptr;
};

/// Whether the solid x contains a point of each connected part of y, or of one of them, whose surfaces do not
/// meet.
bool contains_part(const SeenShape& x, const SeenShape& y);

}  // namespace narrow
}  // namespace touchstone
