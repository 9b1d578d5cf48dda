// From a good direction to a local minimum of the depth, where EPA cannot separate the candidates.
//
// Let x = h(m) m be the foot of the support plane of direction m. EPA is asked for the boundary point nearest
// to s·x (0 < s < 1) and not to the origin: near x that point is isolated even when the origin's nearest
// points form a ring, so EPA closes. Its normal m1 minimises h(m) − s x·m, hence
//     h(m1) <= h(m) (1 − s (1 − m·m1)) <= h(m):
// a proximal step that never climbs and that respects kinks of h. A fixed point is a local minimum. Steps
// along a flat ring are short; each is extended along its great circle while h falls.
#pragma once

#include "core/narrow/epa.h"

namespace touchstone::narrow {

struct DescendLimits {
  int steps = 40, budget = 2000;
};

/// Improves e in place; e.status becomes closed when the last step gained no more than `tolerance`. `lower`
/// is kept: it is what EPA proved of all directions.
template <class R>
void descend(EpaResult<R>& e, const ConvexCore<R>& a, const ConvexCore<R>& b, R size, R tolerance,
             DescendLimits limits = {}) {
  constexpr R share = R(1) / 16;
  const auto height = [&](const V3<R>& n) { return -n.dot(difference_support<R>(a, b, -n).w); };
  for (int i = 0; i < limits.steps; ++i) {
    // D's outward normal is −normal.
    const V3<R> shift = -e.normal * (share * e.upper);
    ConvexCore<R> moved = b;
    moved.frame.translation -= shift;
    const GjkResult<R> g = gjk<R>(a, moved, tolerance, tolerance / 4, limits.budget);
    if (g.status != GjkStatus::enclosed && g.status != GjkStatus::touching) return;
    const EpaResult<R> step = Epa<R>(a, moved, size, tolerance).run(g, limits.budget);
    if (step.status != EpaStatus::closed) return;
    const V3<R> from = e.normal, turn = step.normal - from;
    const R before = e.upper, reached = height(step.normal);
    if (reached <= e.upper) e.upper = reached, e.normal = step.normal;
    for (R t = 2; t * turn.norm() < 1; t *= 2) {
      const V3<R> n = (from + t * turn).normalized();
      const R h = height(n);
      if (!(h < e.upper)) break;
      e.upper = h, e.normal = n;
    }
    if (before - e.upper > tolerance / 4) continue;
    e.a = step.a, e.b = step.b + shift;
    e.upper = reached, e.normal = step.normal;
    e.status = EpaStatus::closed;
    return;
  }
}

}  // namespace touchstone::narrow
