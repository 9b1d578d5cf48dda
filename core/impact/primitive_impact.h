// Deforming primitives: a vertex against a triangle, an edge against an edge, every vertex on a straight path
// over t in [0,1]; when do the closed primitives first come within `min_separation`? Degenerate triangles and
// edges are allowed.
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
  /// > 0: stop at a distance <= min_separation + tolerance and call it contact, which is then a matter of
  /// tolerance. 0: with min_separation 0 every verdict is exact; otherwise the distance that doubles resolve.
  double tolerance = 0;
};

/// What settled the answer.
enum class PrimitiveExit {
  box,        // apart along a coordinate axis throughout
  direction,  // apart along a chain of directions that covers [0,1]
  tolerance,  // closer than asked; contact within the tolerance
  crossing,   // contact, proven in double: through the inside of the primitives
  exact,      // decided in integers
  stuck       // min_separation > 0 and no direction separates further though the distance is larger
};

struct PrimitiveImpact {
  Outcome outcome =
      Outcome::answered;  // invalid_input: a coordinate is not finite, an option < 0; not_converged: stuck
  /// Set: never later than the first contact. Not set with `answered`: proven to be no contact over [0,1].
  std::optional<double> toi;
  double separation = 0;   // at `toi`: a lower bound along the last direction
  double clear_until = 0;  // no contact before this time: proven, also when not_converged
  int steps = 0;           // directions tried
  PrimitiveExit exit = PrimitiveExit::box;
};

/// vertex_face: v f0 f1 f2; edge_edge: a0 a1 b0 b1. At t = 0 and at t = 1.
PrimitiveImpact primitive_impact(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                                 const std::array<Vec3, 4>& end, const PrimitiveOptions& options = {});

}  // namespace touchstone
