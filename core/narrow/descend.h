// From a good direction to a local minimum of the depth, where EPA cannot separate the candidates.
//
// Let x = h(m) m be the foot of the support plane of direction m. EPA is asked for the boundary point nearest
// to s·x (0 < s < 1) and not to the origin: near x that point is isolated even when the origin's nearest
// points form a ring, so EPA closes. Its normal m1 minimises h(m) − s x·m, hence
//     h(m1) <= h(m) (1 − s (1 − m·m1)) <= h(m):
// a proximal step that never climbs and that respects kinks of h. A fixed point is a local minimum. Steps
// along a flat ring are short, so the movement is extrapolated, doubling while h falls; the step from the
// extrapolated direction brings it back onto the ring. When plain steps gain nothing more, long
// extrapolations are tried once before the end.
#pragma once

#include <cmath>

#include "core/narrow/epa.h"

namespace touchstone::narrow {

struct DescendLimits {
  int steps = 150, budget = 2000;
};

namespace detail {

/// The proximal step from direction n (A to B); status closed when it is to be believed.
template <class R>
EpaResult<R> proximal(const V3<R>& n, const ConvexCore<R>& a, const ConvexCore<R>& b, R size, R tolerance,
                      int budget) {
  const auto height = [&](const V3<R>& m) { return -m.dot(difference_support<R>(a, b, -m).w); };
  EpaResult<R> step;
  const V3<R> shift = -n * (height(n) / 16);  // D's outward normal is −n
  ConvexCore<R> moved = b;
  moved.frame.translation -= shift;
  const GjkResult<R> g = gjk<R>(a, moved, tolerance, tolerance / 4, budget);
  if (g.status != GjkStatus::enclosed && g.status != GjkStatus::touching) return step;
  step = Epa<R>(a, moved, size, tolerance).run(g, budget);
  step.b += shift, step.upper = height(step.normal);
  return step;
}

}  // namespace detail

/// Improves e in place; e.status becomes closed at a local minimum. `lower` is kept: it is what EPA proved of
/// all directions.
template <class R>
void descend(EpaResult<R>& e, const ConvexCore<R>& a, const ConvexCore<R>& b, R size, R tolerance,
             DescendLimits limits = {}) {
  const R negligible = 64 * std::numeric_limits<R>::epsilon() * size;
  const R lower = e.lower;
  V3<R> turn = V3<R>::Zero(), plain_turn = turn;
  R stretch = 0;       // 0: plain step
  int last_tries = 0;  // long extrapolations since a plain step gained nothing
  for (int i = 0; i < limits.steps; ++i) {
    const V3<R> from = e.normal, anchor = (from + stretch * turn).normalized();
    const EpaResult<R> step = detail::proximal<R>(anchor, a, b, size, tolerance, limits.budget);
    const bool plain = stretch == 0;
    if (step.status != EpaStatus::closed && plain) return;
    const R gain = step.status == EpaStatus::closed ? e.upper - step.upper : -1;
    if (plain) plain_turn = step.normal - from;
    if (plain ? gain >= -tolerance : gain > negligible) e = step, turn = step.normal - from;
    if (gain > negligible) {
      stretch = turn.norm() < R(0.25) ? 2 : 0, last_tries = 0;
      continue;
    }
    if (!plain && last_tries == 0) {
      stretch = 0;
      continue;
    }
    if (last_tries == 5) {
      e.status = EpaStatus::closed, e.lower = lower;
      return;
    }
    turn = plain_turn, stretch = std::ldexp(R(1), 4 * ++last_tries);
  }
  e.status = EpaStatus::explored, e.lower = lower;
}

}  // namespace touchstone::narrow
