// The narrow phase's door: overlap, signed distance, contact of two placed shapes, every pair but mesh–mesh
// and half-space–half-space (`unsupported`). Numbers are worked out in extended precision on the exact pose
// and rounded once.
#pragma once

#include "core/narrow/result.h"
#include "core/shape/shape.h"

namespace touchstone {

struct PlacedShape {
  const Shape* shape = nullptr;
  Pose pose;
};

/// Gap, normal and witness points before rounding to double; coordinates relative to A's translation.
Separation separation(const PlacedShape& a, const PlacedShape& b);

OverlapAnswer overlap(const PlacedShape& a, const PlacedShape& b);

/// Of a convex body and a mesh that it hits: minus the depth in the deepest triangle.
DistanceAnswer distance(const PlacedShape& a, const PlacedShape& b);

/// Of a mesh: normal, depth and point of the deepest triangle. The normal is a minimum of the depth over
/// directions.
ContactAnswer contact(const PlacedShape& a, const PlacedShape& b);

}  // namespace touchstone
