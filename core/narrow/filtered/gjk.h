// Distance, or only the verdict, of two convex cores in the arithmetic R. Gilbert, Johnson, Keerthi 1988 as
// in core/narrow/gjk.h, in A's frame and without the final retry: if the bounds do not meet, the caller falls
// back to a slower method. Bounds: |v| from above (v a point of B − A), the best support plane from below. A
// tetrahedron of support points that encloses the origin with a margin beyond rounding proves overlap.
#pragma once

#include "core/narrow/filtered/local_depth.h"

namespace touchstone::narrow::filtered {

/// Newton step for the direction n (unit, A to B) whose support point w is parallel to it, as at the nearest
/// point: (H + g) dn = w − g n, where H is the derivative of the support point and g = n·w. Where a body has
/// corners or edges, H is 0 and the step may fail; it only proposes the next direction.
template <class R>
V3<R> newton_direction(const Difference<R>& d, const V3<R>& n, const V3<R>& w) {
  const V3<R> local = d.at.b_to_a.transpose() * -n;
  M3<R> m = support_derivative<R>(d.a, n) +
            d.at.b_to_a * support_derivative<R>(d.b, local) * d.at.b_to_a.transpose();
  const R g = n.dot(w);
  m.diagonal().array() += g;
  const V3<R> r = w - g * n, c0 = m.col(1).cross(m.col(2)), c1 = m.col(2).cross(m.col(0)),
              c2 = m.col(0).cross(m.col(1));
  const R det = c0.dot(m.col(0));
  return n + V3<R>(c0.dot(r), c1.dot(r), c2.dot(r)) / det;
}

enum class WalkEnd {
  bounded,   // upper − lower <= tolerance, or (verdict only) lower > certain
  enclosed,  // the simplex is a tetrahedron around the origin
  touching,  // |v| is within rounding of 0
  stalled    // no progress, or iteration cap
};

template <class R>
struct Walk {
  WalkEnd end = WalkEnd::stalled;
  Simplex<R> simplex;
  R upper = std::numeric_limits<R>::infinity(), lower = -std::numeric_limits<R>::infinity();
  R margin = 0;                   // enclosed: distance of the origin from the boundary
  V3<R> normal = V3<R>::UnitX();  // of the best lower bound, A's frame, A to B
  int iterations = 0;
};

inline constexpr int walk_cap = 96;
/// From this iteration on, every other step of a curved pair is a Newton step. Polytopes have finished by
/// then; a curved pair converges linearly without it.
inline constexpr int walk_help = 5;

/// Uses the direction of v itself when it is accurate enough: the witness points then differ along the
/// normal.
template <class R>
void prefer_own_direction(const Difference<R>& d, Walk<R>& g, const V3<R>& v, R length, R tolerance) {
  g.end = WalkEnd::bounded;
  const V3<R> n = v / length;
  const R lower = n.dot(d.support(-n).w);
  if (g.upper - lower <= tolerance) {
    g.lower = lower;
    g.normal = n;
  }
}

/// Guesses the touching features from the simplex and computes their nearest points: if the guess is right, a
/// curved pair is finished.
template <class R>
bool settle(const Difference<R>& d, Walk<R>& g, R size, R tolerance) {
  std::array<Vertex<R>, 3> facet;
  std::array<R, 3> weight{};
  for (std::size_t k = 0; k < 3; ++k) {
    const bool own = static_cast<int>(k) < g.simplex.size;
    facet[k] = g.simplex.p[own ? k : 0];
    weight[k] = own ? g.simplex.weight[k] : R(0);
  }
  LocalMinimum<R> at(d, size);
  if (!at.find(facet, weight, -g.normal)) return false;
  const R length = at.point().norm();
  if (!(length + at.height() <= tolerance)) return false;
  g.simplex.size = 1;
  g.simplex.weight[0] = 1;
  g.simplex.p[0] = {at.point(), at.on_a()};
  g.upper = length;
  g.lower = -at.height();
  g.normal = -at.outward();
  g.end = WalkEnd::bounded;
  return true;
}

/// `certain`: a lower bound that ends the iteration when only the verdict is requested; infinite otherwise.
/// `size`: size of the pair, which rounding is relative to. `guess`: an initial direction from A to B, or
/// zero.
template <class R>
Walk<R> walk(const Difference<R>& d, R tolerance, R certain, R size, const V3<R>& guess) {
  const R touching = 4 * u<R> * size;
  Walk<R> g;
  const R guessed = guess.squaredNorm();
  V3<R> v = guessed > R(0.5) && guessed < 2 ? guess : d.at.offset;
  R dist_sq = v.squaredNorm(), length = std::sqrt(dist_sq);
  if (!(length > 0)) {
    v = V3<R>::UnitX();
    length = 1;
  }
  dist_sq = std::numeric_limits<R>::infinity();
  const bool curved = is_curved(d.a) || is_curved(d.b);
  int idle = 0;
  V3<R> best_w = V3<R>::Zero();  // support point of the best lower bound
  for (g.iterations = 1; g.iterations <= walk_cap; ++g.iterations) {
    V3<R> n = v / length;
    if (curved && certain > size && g.iterations % 3 == 2 && g.iterations > 4 && g.lower > 0 &&
        settle(d, g, size, tolerance))
      return g;
    if (curved && g.iterations > walk_help && g.iterations % 2 == 0 && g.lower > 0) {
      const V3<R> step = newton_direction(d, g.normal, best_w);
      const R size = step.norm();
      if (size > R(0.5) && size < 2) n = step / size;
    }
    const Vertex<R> s = d.support(-n);
    const R lower = n.dot(s.w);
    const bool better = lower > g.lower;
    if (better) {
      g.lower = lower;
      g.normal = n;
      best_w = s.w;
    }
    if (g.lower > certain) {
      g.end = WalkEnd::bounded;
      return g;
    }
    if (g.upper - g.lower <= tolerance) {
      prefer_own_direction(d, g, v, length, tolerance);
      return g;
    }
    if (g.simplex.size == 4 || (idle > 3 && !better)) return g;
    g.simplex.p[static_cast<std::size_t>(g.simplex.size++)] = s;
    const R last = dist_sq;
    if (reduce(g.simplex, v, dist_sq, g.margin)) {
      g.end = WalkEnd::enclosed;
      return g;
    }
    idle = dist_sq < last ? 0 : idle + 1;
    length = std::sqrt(dist_sq);
    g.upper = length;
    if (!(length > touching)) {
      g.end = WalkEnd::touching;
      return g;
    }
  }
  return g;
}

}  // namespace touchstone::narrow::filtered
