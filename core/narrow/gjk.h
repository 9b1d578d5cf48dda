// Distance of two convex cores. Gilbert, Johnson, Keerthi 1988, in the form of van den Bergen 1999: the
// iteration ends on the gap between an upper bound |v| (v is a point of B − A) and the lower bound −w(n) of
// the best support plane seen, so that both bounds hold whatever the simplices were. There is no absolute
// epsilon: `tolerance` and `touching` are lengths that the caller derives from the size of the pair.
#pragma once

#include <array>

#include "core/narrow/convex_core.h"
#include "core/narrow/simplex.h"

namespace touchstone::narrow {

enum class GjkStatus {
  separated,  // upper − lower <= tolerance
  enclosed,   // the origin is inside the tetrahedron `simplex`
  touching,   // |v| <= touching: indistinguishable from contact here; EPA decides
  stalled,    // no progress in this arithmetic; bounds are valid but have not met
  capped      // iteration cap
};

template <class R>
struct GjkResult {
  GjkStatus status = GjkStatus::stalled;
  std::array<DifferenceVertex<R>, 4> simplex;
  std::array<R, 4> weight{};
  int size = 0;
  R upper = 0;                                 // |v|
  R lower = 0;                                 // −w(normal); may be negative
  V3<R> normal = V3<R>::Zero();                // unit, A to B, of the best lower bound
  V3<R> a = V3<R>::Zero(), b = V3<R>::Zero();  // core points with b − a = v
  int iterations = 0;
};

namespace detail {

template <class R>
void keep_weighted(GjkResult<R>& g, const ClosestPoint<R>& c) {
  int kept = 0;
  V3<R> a = V3<R>::Zero(), b = V3<R>::Zero();
  for (int i = 0; i < g.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!(c.weight[k] > 0)) continue;
    a += c.weight[k] * g.simplex[k].a;
    b += c.weight[k] * g.simplex[k].b;
    g.simplex[static_cast<std::size_t>(kept)] = g.simplex[k];
    g.weight[static_cast<std::size_t>(kept++)] = c.weight[k];
  }
  g.size = kept;
  g.a = a;
  g.b = b;
  g.upper = sqrt(c.dist_sq);
}

template <class R>
ClosestPoint<R> closest_of(const GjkResult<R>& g) {
  std::array<const V3<R>*, 4> p{};
  for (std::size_t i = 0; i < 4; ++i) p[i] = &g.simplex[i].w;
  return closest_to_origin<R>(std::span(p.data(), static_cast<std::size_t>(g.size)));
}

// When rounding stalls the iteration: tries the normals of all triangles of the last support points as
// support planes. One of them is the plane (or the plane through the edge) around which the iteration was
// cycling.
template <class R>
void polish(GjkResult<R>& g, const ConvexCore<R>& a, const ConvexCore<R>& b,
            std::span<const DifferenceVertex<R>> seen) {
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t j = i + 1; j < seen.size(); ++j)
      for (std::size_t k = j + 1; k < seen.size(); ++k) {
        V3<R> n = triangle_normal<R>(seen[i].w, seen[j].w, seen[k].w);
        if (!(n.squaredNorm() > 0)) continue;
        n.normalize();
        if (n.dot(seen[i].w) < 0) n = -n;
        const R lower = n.dot(difference_support<R>(a, b, -n).w);
        if (lower > g.lower) {
          g.lower = lower;
          g.normal = n;
        }
      }
}

}  // namespace detail

template <class R>
GjkResult<R> gjk(const ConvexCore<R>& a, const ConvexCore<R>& b, R tolerance, R touching,
                 int max_iterations) {
  GjkResult<R> g;
  V3<R> v = b.frame.translation - a.frame.translation;
  if (v.isZero(0)) v = V3<R>::UnitX();
  g.simplex[0] = difference_support<R>(a, b, -v);
  g.size = 1;
  g.lower = -std::numeric_limits<R>::infinity();
  constexpr int max_idle = 8;
  int idle = 0, seen = 0;
  std::array<DifferenceVertex<R>, 10> recent;
  R last_sq = std::numeric_limits<R>::infinity();
  for (g.iterations = 1; g.iterations <= max_iterations; ++g.iterations) {
    const ClosestPoint<R> c = detail::closest_of(g);
    // A support plane that separates the origin is proof; the signs of a flat tetrahedron are not.
    if (c.encloses && g.lower > 0) break;
    if (c.encloses) {
      g.status = GjkStatus::enclosed;
      return g;
    }
    // Near the end the distance stagnates to an ulp while the direction still improves.
    idle = c.dist_sq < last_sq ? 0 : idle + 1;
    if (idle > max_idle) break;
    last_sq = std::min(last_sq, c.dist_sq);
    v = c.point;
    detail::keep_weighted(g, c);
    if (g.upper <= touching) {
      g.status = GjkStatus::touching;
      return g;
    }
    const V3<R> n = v / g.upper;
    const DifferenceVertex<R> s = difference_support<R>(a, b, -n);
    if (const R lower = n.dot(s.w); lower > g.lower) {
      g.lower = lower;
      g.normal = n;
      idle = 0;
    }
    if (g.upper - g.lower <= tolerance) {
      g.status = GjkStatus::separated;
      return g;
    }
    if (g.size == 4) break;
    g.simplex[static_cast<std::size_t>(g.size++)] = s;
    recent[static_cast<std::size_t>(seen++) % recent.size()] = s;
  }
  if (g.iterations > max_iterations) {
    g.status = GjkStatus::capped;
    return g;
  }
  detail::polish<R>(
      g, a, b,
      std::span(recent.data(), std::min<std::size_t>(static_cast<std::size_t>(seen), recent.size())));
  g.status = g.upper - g.lower <= tolerance ? GjkStatus::separated : GjkStatus::stalled;
  return g;
}

}  // namespace touchstone::narrow
