// Deforming primitives: a vertex against a triangle or an edge against an edge, every vertex on a straight
// path over t in [0,1]. Decided exactly; nothing is left undecided.
#pragma once

#include <array>

#include "core/math/pose.h"

namespace touchstone::referee {

enum class PrimitivePair { vertex_face, edge_edge };

struct PrimitiveTruth {
  bool collides = false;      // the closed primitives share a point at some t in [0,1]
  double t_lo = 0, t_hi = 0;  // bracket the first such t: one double, or two neighbours
};

/// vertex_face: v f0 f1 f2; edge_edge: a0 a1 b0 b1. Positions at t = 0 and at t = 1, all finite.
PrimitiveTruth judge_primitive_motion(PrimitivePair kind, const std::array<Vec3, 4>& start,
                                      const std::array<Vec3, 4>& end);

}  // namespace touchstone::referee
