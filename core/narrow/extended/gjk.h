// The iteration of core/narrow/gjk.h in extended precision, in which it decides what doubles could not: with
// a last attempt when it stalls, and the nearest points of both cores.
#pragma once

#include "core/narrow/convex_core.h"
#include "core/narrow/gjk.h"

namespace touchstone::narrow::extended {

/// B − A of two placed cores.
template <class R>
struct Difference {
  const ConvexCore<R>&a, &b;
  /// A point of B − A farthest along d.
  Vertex<R> support(const V3<R>& d) const {
    const V3<R> from = narrow::support<R>(a, -d);
    return {narrow::support<R>(b, d) - from, from};
  }
  /// How far B must move along the unit vector n to leave A; negative if they are apart along it.
  R height(const V3<R>& n) const { return -n.dot(support(-n).w); }
};

template <class R>
struct Distance : GjkResult<R> {
  V3<R> a = V3<R>::Zero(), b = V3<R>::Zero();  // core points, |b − a| = upper
};

namespace detail {

/// The last support points that the iteration has seen.
template <class R>
class Recent {
 public:
  static constexpr bool careful = true;
  bool settle(const GjkResult<R>&) const { return false; }
  V3<R> direction(const GjkResult<R>&, const V3<R>& n, const V3<R>&) const { return n; }
  void see(const Vertex<R>& s) { seen_[count_++ % seen_.size()] = s; }
  std::size_t size() const { return std::min(count_, seen_.size()); }
  const V3<R>& operator[](std::size_t i) const { return seen_[i].w; }

 private:
  std::array<Vertex<R>, 10> seen_;
  std::size_t count_ = 0;
};

// When rounding stalls the iteration: tries the normals of all triangles of the last support points as
// support planes. One of them is the plane (or the plane through the edge) around which the iteration was
// cycling.
template <class R>
void polish(GjkResult<R>& g, const Difference<R>& d, const Recent<R>& seen) {
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t j = i + 1; j < seen.size(); ++j)
      for (std::size_t k = j + 1; k < seen.size(); ++k) {
        V3<R> n = upright_normal<R>(seen[i], seen[j], seen[k]);
        if (!(n.squaredNorm() > 0)) continue;
        n.normalize();
        if (n.dot(seen[i]) < 0) n = -n;
        const R lower = n.dot(d.support(-n).w);
        if (lower > g.lower) {
          g.lower = lower;
          g.normal = n;
        }
      }
}

template <class R>
Distance<R> attempt(const Difference<R>& d, const GjkLimits<R>& limit, const V3<R>& start) {
  Recent<R> recent;
  Distance<R> g;
  static_cast<GjkResult<R>&>(g) = narrow::gjk<R>(d, limit, start, recent);
  // A support plane that separates the origin is proof; the signs of a flat tetrahedron are not.
  if (g.status == GjkStatus::enclosed && g.lower > 0) g.status = GjkStatus::stalled;
  if (g.status == GjkStatus::stalled) {
    polish(g, d, recent);
    if (g.upper - g.lower <= limit.tolerance) g.status = GjkStatus::separated;
  }
  return g;
}

template <class R>
void set_points(Distance<R>& g) {
  Simplex<R>& s = g.simplex;
  if (s.size == 3) {
    const V3<R> n = upright_normal<R>(s.p[0].w, s.p[1].w, s.p[2].w);
    const V3<R> foot = n * (n.dot(s.p[0].w) / n.squaredNorm());
    refine_weights<R>(s.p[0].w, s.p[1].w, s.p[2].w, foot, s.weight.data());
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(s.size); ++k) {
    g.a += s.weight[k] * s.p[k].a;
    g.b += s.weight[k] * (s.p[k].a + s.p[k].w);
  }
}

}  // namespace detail

template <class R>
Distance<R> gjk(const ConvexCore<R>& a, const ConvexCore<R>& b, R tolerance, R touching, int iterations) {
  constexpr int most_restarts = 3;
  constexpr int idle = 8;  // near the end the distance stagnates to an ulp while the direction still improves
  const Difference<R> d{a, b};
  const GjkLimits<R> limit{tolerance, std::numeric_limits<R>::infinity(), touching, iterations, idle};
  Distance<R> g = detail::attempt<R>(d, limit, b.frame.translation - a.frame.translation);
  // From the best direction known, the simplex has no points from far away, whose rounding stalled it.
  for (int again = 0; again < most_restarts && g.status == GjkStatus::stalled && g.lower > 0; ++again) {
    const Distance<R> r = detail::attempt<R>(d, limit, g.normal);
    if (!(r.lower > 0) || !(r.upper - r.lower < g.upper - g.lower)) break;
    g = r;
  }
  if (g.status != GjkStatus::enclosed) detail::set_points(g);
  return g;
}

}  // namespace touchstone::narrow::extended
