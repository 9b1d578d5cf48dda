// Deforming primitives: a vertex against a triangle, or an edge against an edge, with every vertex on a
// straight path over t in [0,1]. Finds when the closed primitives first come within `min_separation`.
// Degenerate triangles and edges are allowed.
#pragma once

#include <array>
#include <optional>

#include "core/base/outcome.h"
#include "core/math/pose.h"

namespace touchstone {

enum class PrimitiveKind { vertex_face, edge_edge };

struct PrimitiveOptions {
  /// Contact is a distance <= this (Euclidean, scene's unit), >= 0.
  double min_separation = 0;
  /// > 0: stop at a distance <= min_separation + tolerance and report contact, to within the tolerance. 0:
  /// with min_separation 0 every verdict is exact; otherwise accurate to the distance that doubles resolve.
  double tolerance = 0;
};

/// What decided the answer.
enum class PrimitiveExit {
  box,        // separated along a coordinate axis throughout
  direction,  // separated by a chain of directions that covers [0,1]
  tolerance,  // closer than the limit; contact within the tolerance
  crossing,   // contact, proven in double: crossing in their interiors
  exact,      // decided in integers
  stuck       // min_separation > 0, and no direction separates although the distance is larger
};

struct PrimitiveImpact {
  /// invalid_input: a coordinate is not finite or an option is < 0; not_converged: `stuck`.
  Outcome outcome = Outcome::answered;
  /// Set: never later than the first contact. Not set with `answered`: no contact over [0,1], proven.
  std::optional<double> toi;
  double separation = 0;   // at `toi`: a lower bound along the last direction
  double clear_until = 0;  // no contact before this time; proven, also when not_converged
  int steps = 0;           // directions tried
  PrimitiveExit exit = PrimitiveExit::box;
};

/// vertex_face: v f0 f1 f2; edge_edge: a0 a1 b0 b1. Positions at t = 0 and at t = 1.
PrimitiveImpact primitive_impact(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                                 const std::array<Vec3, 4>& end, const PrimitiveOptions& options = {});

}  // namespace touchstone
