// Gilbert, Johnson, Keerthi 1988. Departures: the nearest point of a simplex is found by trying all of its
// faces and keeping the nearest candidate among those with non-negative weights, which stays a point of the
// simplex whatever rounding does to slivers; the search direction of a triangle is its normal, which stays
// accurate when the nearest point shrinks to the size of rounding. Guarantee: every `raise` is a support
// plane and every `lower` a pair of points, so the bracket is true on every exit.
#include "oracles/referee/filter/gjk.h"

#include <algorithm>

#include "oracles/referee/filter/wide.h"

namespace touchstone::referee {
namespace {

constexpr int iteration_cap = 256;
// Steps that neither raise the lower bound nor lower the upper one before giving up.
constexpr int patience = 12;

template <class T>
struct Candidate {
  std::array<T, 4> weight{};
  Triple<T> nearest, outward;
  T dist_sq = std::numeric_limits<T>::infinity();
};

template <class T>
void try_point(Candidate<T>& best, const BasicSimplex<T>& s, int i) {
  const Triple<T>& w = s.vertex[static_cast<std::size_t>(i)].w;
  const T dist_sq = dot(w, w);
  if (!(dist_sq < best.dist_sq)) return;
  best = {{}, w, w, dist_sq};
  best.weight[static_cast<std::size_t>(i)] = 1;
}

template <class T>
void try_edge(Candidate<T>& best, const BasicSimplex<T>& s, int i, int j) {
  const Triple<T>&p = s.vertex[static_cast<std::size_t>(i)].w, &q = s.vertex[static_cast<std::size_t>(j)].w;
  const Triple<T> d = q - p;
  const T dd = dot(d, d), t = -dot(p, d);
  if (!(t > 0 && t < dd)) return;
  const T x = (dd - t) / dd, y = t / dd;
  const Triple<T> nearest = x * p + y * q;
  const T dist_sq = dot(nearest, nearest);
  if (!(dist_sq < best.dist_sq)) return;
  best = {{}, nearest, nearest, dist_sq};
  best.weight[static_cast<std::size_t>(i)] = x;
  best.weight[static_cast<std::size_t>(j)] = y;
}

template <class T>
void try_triangle(Candidate<T>& best, const BasicSimplex<T>& s, int i, int j, int k) {
  const Triple<T>&p = s.vertex[static_cast<std::size_t>(i)].w, &q = s.vertex[static_cast<std::size_t>(j)].w,
        &r = s.vertex[static_cast<std::size_t>(k)].w;
  Triple<T> n = triangle_normal(p, q, r);
  const T a = dot(cross(q, r), n), b = dot(cross(r, p), n), c = dot(cross(p, q), n);
  if (!(a > 0 && b > 0 && c > 0)) return;
  if (dot(n, p) < 0) n = -n;
  const T sum = a + b + c, x = a / sum, y = b / sum, z = c / sum;
  const Triple<T> nearest = x * p + y * q + z * r;
  const T dist_sq = dot(nearest, nearest);
  if (!(dist_sq < best.dist_sq)) return;
  best = {{}, nearest, n, dist_sq};
  best.weight[static_cast<std::size_t>(i)] = x;
  best.weight[static_cast<std::size_t>(j)] = y;
  best.weight[static_cast<std::size_t>(k)] = z;
}

template <class T>
bool try_tetrahedron(Candidate<T>& best, const BasicSimplex<T>& s) {
  const Triple<T>&p = s.vertex[0].w, &q = s.vertex[1].w, &r = s.vertex[2].w, &t = s.vertex[3].w;
  const T a = dot(q, cross(r, t)), b = -dot(p, cross(r, t)), c = dot(p, cross(q, t)),
          d = -dot(p, cross(q, r));
  const bool inside = (a > 0 && b > 0 && c > 0 && d > 0) || (a < 0 && b < 0 && c < 0 && d < 0);
  if (!inside) return false;
  const T sum = a + b + c + d;
  best.weight = {a / sum, b / sum, c / sum, d / sum};
  best.nearest = best.weight[0] * p + best.weight[1] * q + best.weight[2] * r + best.weight[3] * t;
  best.outward = best.nearest;
  return true;
}

template <class T>
bool holds(const BasicSimplex<T>& s, const BasicVertex<T>& v) {
  for (int i = 0; i < s.size; ++i) {
    const BasicVertex<T>& u = s.vertex[static_cast<std::size_t>(i)];
    if (u.w.x == v.w.x && u.w.y == v.w.y && u.w.z == v.w.z) return true;
  }
  return false;
}

template <class T>
void keep_weighted(BasicSimplex<T>& s, const Candidate<T>& c) {
  int n = 0;
  for (int i = 0; i < s.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (c.weight[k] == 0) continue;
    s.vertex[static_cast<std::size_t>(n)] = s.vertex[k];
    s.weight[static_cast<std::size_t>(n++)] = c.weight[k];
  }
  s.size = n;
  s.nearest = c.nearest;
  s.outward = c.outward;
}

}  // namespace

template <class T>
void reduce(BasicSimplex<T>& s) {
  Candidate<T> best;
  if (s.size == 4 && try_tetrahedron(best, s)) return keep_weighted(s, best);
  for (int i = 0; i < s.size; ++i) try_point(best, s, i);
  for (int i = 0; i < s.size; ++i)
    for (int j = i + 1; j < s.size; ++j) try_edge(best, s, i, j);
  for (int i = 0; i < s.size; ++i)
    for (int j = i + 1; j < s.size; ++j)
      for (int k = j + 1; k < s.size; ++k) try_triangle(best, s, i, j, k);
  keep_weighted(s, best);
}

template <class T>
BasicGjkResult<T> gjk(const BasicDifference<T>& d, std::span<const Triple<T>> hints,
                      std::type_identity_t<T> target, const BasicSimplex<T>* seed) {
  using Exit = typename BasicGjkResult<T>::Exit;
  BasicGjkResult<T> r;
  BasicSimplex<T>& s = r.simplex;
  const auto support_along = [&](const Triple<T>& n) {
    const BasicVertex<T> v = d.support(n);
    r.gap.raise(-d.width_above(v, n), n);
    return v;
  };
  const auto add_vertex = [&](const BasicVertex<T>& v) {
    s.vertex[static_cast<std::size_t>(s.size++)] = v;
    reduce(s);
  };
  if (seed && seed->size > 0) {
    s = *seed;
    reduce(s);
  } else {
    for (const Triple<T>& n : hints)
      if (const BasicVertex<T> v = support_along(n); s.size < 4 && !holds(s, v)) add_vertex(v);
  }
  if (s.size == 0) add_vertex(support_along({1, 0, 0}));
  int idle = 0;
  for (int i = 0; i < iteration_cap; ++i) {
    const T lo = r.gap.lo, hi = r.gap.hi;
    // Weights sum to 1 within 8 units and the sum is rounded: 16 units of the extent.
    r.gap.lower(norm(s.nearest) + projection_rounding_of<T> * d.extent + d.error);
    if (s.size == 4) {
      r.exit = Exit::encloses_origin;
      return r;
    }
    if (largest(s.outward) == 0) {
      r.exit = Exit::touches;
      return r;
    }
    const BasicVertex<T> v = support_along(-normalized(s.outward));
    if (r.gap.hi - r.gap.lo <= target) {
      r.exit = Exit::converged;
      return r;
    }
    if (holds(s, v)) {
      r.exit = Exit::no_progress;
      return r;
    }
    idle = r.gap.lo > lo || r.gap.hi < hi ? 0 : idle + 1;
    if (idle > patience) {
      r.exit = Exit::no_progress;
      return r;
    }
    add_vertex(v);
  }
  return r;
}

template void reduce(BasicSimplex<double>&);
template void reduce(BasicSimplex<Real>&);
template void reduce(BasicSimplex<Wide>&);
template BasicGjkResult<double> gjk(const BasicDifference<double>&, std::span<const Triple<double>>, double,
                                    const BasicSimplex<double>*);
template BasicGjkResult<Real> gjk(const BasicDifference<Real>&, std::span<const Triple<Real>>, Real,
                                  const BasicSimplex<Real>*);
template BasicGjkResult<Wide> gjk(const BasicDifference<Wide>&, std::span<const Triple<Wide>>, Wide,
                                  const BasicSimplex<Wide>*);

}  // namespace touchstone::referee
