// Contact manifold of a touching or overlapping pair: the intersection of the two faces that support the
// bodies along the normal, as a polygon, a segment or a point, halfway between the two support planes. Only
// points of the exact support faces are used (within manifold_face_factor), so each lies within depth/2 of
// both bodies and has the full depth. A face tilted by more than that against the normal contributes its
// deepest edge or vertex. Round faces (caps of cylinders, bases of cones) are represented by inscribed
// polygons (rim.h), and by points of the rim where the other outline cuts it (flat_rims.h).
#pragma once

#include <vector>

#include "core/narrow/convex_core.h"
#include "core/narrow/result.h"

namespace touchstone::narrow {

/// A point of a manifold. `id` names its features (filtered/patch.h); 0: none.
struct ManifoldVertex {
  WideVec p;
  std::uint32_t id;
};

/// `b` null: a half-space. Its support face is unbounded, so the face of `a` is the manifold.
std::vector<ManifoldVertex> contact_points(const ConvexCore<Wide>& a, const ConvexCore<Wide>* b,
                                           const Separation& s);

}  // namespace touchstone::narrow
