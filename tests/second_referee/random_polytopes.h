// Pairs whose world coordinates are rationals with one small denominator, so that both referees get the same
// numbers.
#pragma once

#include "core/math/rng.h"
#include "tests/second_referee/second_referee.h"

namespace touchstone::second_referee {

/// Two hulls of integer vertices at integer poses: quaternions of small integers, mostly not unit.
struct PolytopePair {
  Hull hull_a, hull_b;
  Pose pose_a, pose_b;
  Polytope a, b;     // their world vertices times `scale`
  double scale = 1;  // the product of both squared quaternion lengths
};
PolytopePair random_pair(Rng& r);

/// A surface of a few triangles with vertices on a small lattice, or anywhere; each triangle has an area.
TriangleMesh random_mesh(Rng& r);

}  // namespace touchstone::second_referee
