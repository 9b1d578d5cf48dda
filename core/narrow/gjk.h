// Distance, or only the verdict, of two convex cores, given by the support points of their Minkowski
// difference D = B − A. Gilbert, Johnson, Keerthi 1988, in the form of van den Bergen 1999: the iteration
// ends on the gap between an upper bound |v| (v is a point of D) and the lower bound n·w(n) of the best
// support plane seen, so that both bounds hold whatever the simplices were. There is no absolute epsilon:
// tolerances are lengths that the caller derives from the size of the pair.
//
// One iteration for two arithmetics. In double and float (filtered/gjk.h) the caller proves its own error and
// falls back where the bounds do not meet; in extended precision (extended/gjk.h) it decides the rest.
#pragma once

#include <type_traits>

#include "core/narrow/simplex.h"

namespace touchstone::narrow {

enum class GjkStatus {
  separated,  // upper − lower <= tolerance, or (verdict only) lower > certain
  enclosed,   // the simplex is a tetrahedron around the origin
  touching,   // |v| <= touching: indistinguishable from contact here
  stalled,    // no progress in this arithmetic; bounds are valid but have not met
  capped      // iteration cap
};

template <class R>
struct GjkResult {
  GjkStatus status = GjkStatus::stalled;
  Simplex<R> simplex;
  R upper = std::numeric_limits<R>::infinity(), lower = -std::numeric_limits<R>::infinity();
  R margin = 0;                   // enclosed: distance of the origin from the boundary, less rounding
  V3<R> normal = V3<R>::UnitX();  // unit, A to B, of the best lower bound
  int iterations = 0;
};

/// When the iteration ends.
template <class R>
struct GjkLimits {
  R tolerance;     // gap between the bounds
  R certain;       // a lower bound that is enough for the verdict; infinite for a distance
  R touching;      // |v|
  int iterations;  // at most
  int idle;        // consecutive ones that shorten v no more, unless the lower bound still improves
};

/// Uses the direction of v itself when it is accurate enough: the witness points then differ along the
/// normal.
template <class R, class D>
void prefer_own_direction(const D& d, GjkResult<R>& g, const V3<R>& v, R length, R tolerance) {
  const V3<R> n = v / length;
  const R lower = n.dot(d.support(-n).w);
  if (g.upper - lower <= tolerance) {
    g.lower = lower;
    g.normal = n;
  }
}

/// D: `d.support(n)` is the Vertex of B − A farthest along n. `start`: a first direction from A to B, or
/// zero. Help proposes directions and may end the iteration: `settle(g)` is asked before each support point,
/// `direction(g, n, w)` replaces the next direction n, w being the support point of the best lower bound, and
/// `see(s)` is told each support point; `careful`: of reduce().
template <class R, class D, class Help>
GjkResult<R> gjk(const D& d, const GjkLimits<R>& limit, const V3<R>& start, Help&& help) {
  using std::sqrt;
  GjkResult<R> g;
  V3<R> v = start;
  R dist_sq = v.squaredNorm(), length = sqrt(dist_sq);
  if (!(length > 0)) {
    v = V3<R>::UnitX();
    length = 1;
  }
  dist_sq = std::numeric_limits<R>::infinity();
  int idle = 0;
  V3<R> best_w = V3<R>::Zero();  // support point of the best lower bound
  for (g.iterations = 1; g.iterations <= limit.iterations; ++g.iterations) {
    if (help.settle(g)) {
      g.status = GjkStatus::separated;
      return g;
    }
    const V3<R> n = help.direction(g, V3<R>(v / length), best_w);
    const Vertex<R> s = d.support(-n);
    help.see(s);
    const R lower = n.dot(s.w);
    const bool better = lower > g.lower;
    if (better) {
      g.lower = lower;
      g.normal = n;
      best_w = s.w;
    }
    if (g.lower > limit.certain) {
      g.status = GjkStatus::separated;
      return g;
    }
    if (g.upper - g.lower <= limit.tolerance) {
      g.status = GjkStatus::separated;
      prefer_own_direction(d, g, v, length, limit.tolerance);
      return g;
    }
    if (g.simplex.size == 4 || (idle > limit.idle && !better)) return g;
    g.simplex.p[static_cast<std::size_t>(g.simplex.size++)] = s;
    const R last = dist_sq;
    if (reduce<std::remove_reference_t<Help>::careful>(g.simplex, v, dist_sq, g.margin)) {
      g.status = GjkStatus::enclosed;
      return g;
    }
    idle = dist_sq < last ? 0 : idle + 1;
    length = sqrt(dist_sq);
    g.upper = length;
    if (!(length > limit.touching)) {
      g.status = GjkStatus::touching;
      return g;
    }
  }
  g.status = GjkStatus::capped;
  return g;
}

}  // namespace touchstone::narrow
