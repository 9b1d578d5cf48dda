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

/// What a caller may keep of a pair from one query to the next, of either kind of question, for a search to
/// begin where the last one ended: a direction that parted the two bodies, or the last normal. A guess and no
/// more: verdicts, bounds and their proofs do not depend on it, numbers do within their bounds. Goes with the
/// ordered pair.
struct PairMemory {
  Vec3 direction = Vec3::Zero();  // in a body's frame; zero: nothing is known yet
};

/// float64: as above. float64_alone: every step is taken in double, nothing else comes to its aid: the
/// verdict is the sign of the gap however small, `not_converged` where double cannot tell the gap as well as
/// asked. float32: poses and sizes are rounded to float, and the same in float; meshes are `unsupported`.
enum class Arithmetic { float64, float64_alone, float32 };

/// Gap, normal and witness points before rounding to double; coordinates relative to A's translation.
Separation separation(const PlacedShape& a, const PlacedShape& b);

OverlapAnswer overlap(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic = Arithmetic::float64,
                      PairMemory* memory = nullptr);

/// Of a convex body and a mesh that it hits: minus the depth in the deepest triangle.
DistanceAnswer distance(const PlacedShape& a, const PlacedShape& b,
                        Arithmetic arithmetic = Arithmetic::float64, PairMemory* memory = nullptr);

/// Of a mesh: normal, depth and point of the deepest triangle. The normal is a minimum of the depth over
/// directions.
ContactAnswer contact(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic = Arithmetic::float64,
                      PairMemory* memory = nullptr);

/// At most four points of a manifold: the deepest, the one farthest from it, and on either side of their line
/// the one that spans most area.
Manifold reduced(const ContactAnswer& contact);

}  // namespace touchstone
