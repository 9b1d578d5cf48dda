// The narrow phase's door: overlap, signed distance, contact of two placed shapes, every pair but mesh–mesh
// and half-space–half-space (`unsupported`). Numbers are worked out in double, with a proven bound of their
// error; where that bound cannot decide a verdict or exceeds τ, in extended precision on the exact pose,
// rounded once.
#pragma once

#include "core/narrow/result.h"
#include "core/shape/shape.h"

namespace touchstone {

struct MeshTree;
struct HullGraph;

struct PlacedShape {
  const Shape* shape = nullptr;
  Pose pose;
  /// Of a mesh, mesh_tree.h: what spares looking at every triangle. Same answers without.
  const MeshTree* tree = nullptr;
  /// Of a hull, hull_graph.h: what spares looking at every vertex. Same answers without.
  const HullGraph* graph = nullptr;
};

/// float64: as above. float32: poses and sizes are rounded to float and every step is taken in float, nothing
/// else comes to its aid: `not_converged` where float cannot tell, meshes are `unsupported`.
enum class Arithmetic { float64, float32 };

/// Gap, normal and witness points before rounding to double; coordinates relative to A's translation.
Separation separation(const PlacedShape& a, const PlacedShape& b);

OverlapAnswer overlap(const PlacedShape& a, const PlacedShape& b,
                      Arithmetic arithmetic = Arithmetic::float64);

/// Of a convex body and a mesh that it hits: minus the depth in the deepest triangle.
DistanceAnswer distance(const PlacedShape& a, const PlacedShape& b,
                        Arithmetic arithmetic = Arithmetic::float64);

/// Of a mesh: normal, depth and point of the deepest triangle. The normal is a minimum of the depth over
/// directions.
ContactAnswer contact(const PlacedShape& a, const PlacedShape& b,
                      Arithmetic arithmetic = Arithmetic::float64);

/// At most four points of a manifold: the deepest, the one farthest from it, and on either side of their line
/// the one that spans most area.
Manifold reduced(const ContactAnswer& contact);

}  // namespace touchstone
