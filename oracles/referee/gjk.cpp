// Gilbert, Johnson, Keerthi 1988. Departures: the nearest point of a simplex is found by trying all of its
// faces and keeping the nearest candidate of those whose weights are not negative, which stays a point of the
// simplex whatever the rounding does to slivers; the search direction of a triangle is its normal, which
// keeps its accuracy when the nearest point shrinks to rounding size. Guarantee: every `raise` is a support
// plane and every `lower` a pair of points, so the bracket is true on every exit.
#include "oracles/referee/gjk.h"

#include <algorithm>

namespace touchstone::referee {
namespace {

constexpr int iteration_cap = 256;
constexpr int patience =
    12;  // steps that neither raise the lower bound nor lower the upper one before giving up

struct Candidate {
  std::array<Real, 4> weight{};
  Real3 nearest, outward;
  Real dist_sq = std::numeric_limits<Real>::infinity();
};

void offer(Candidate& best, const Simplex& s, std::array<Real, 4> weight, const Real3* normal) {
  Real sum = 0;
  for (Real x : weight) sum += x;
  Candidate c;
  for (int i = 0; i < s.size; ++i) {
    c.weight[static_cast<std::size_t>(i)] = weight[static_cast<std::size_t>(i)] / sum;
    c.nearest = c.nearest + c.weight[static_cast<std::size_t>(i)] * s.vertex[static_cast<std::size_t>(i)].w;
  }
  c.dist_sq = dot(c.nearest, c.nearest);
  if (!(c.dist_sq < best.dist_sq)) return;
  c.outward = normal ? *normal : c.nearest;
  best = c;
}

void try_point(Candidate& best, const Simplex& s, int i) {
  std::array<Real, 4> w{};
  w[static_cast<std::size_t>(i)] = 1;
  offer(best, s, w, nullptr);
}

void try_edge(Candidate& best, const Simplex& s, int i, int j) {
  const Real3 &p = s.vertex[static_cast<std::size_t>(i)].w, &q = s.vertex[static_cast<std::size_t>(j)].w;
  const Real3 d = q - p;
  const Real dd = dot(d, d), t = -dot(p, d);
  if (!(t > 0 && t < dd)) return;
  std::array<Real, 4> w{};
  w[static_cast<std::size_t>(i)] = (dd - t) / dd;
  w[static_cast<std::size_t>(j)] = t / dd;
  offer(best, s, w, nullptr);
}

void try_triangle(Candidate& best, const Simplex& s, int i, int j, int k) {
  const Real3 &p = s.vertex[static_cast<std::size_t>(i)].w, &q = s.vertex[static_cast<std::size_t>(j)].w,
              &r = s.vertex[static_cast<std::size_t>(k)].w;
  Real3 n = cross(q - p, r - p);
  const Real a = dot(cross(q, r), n), b = dot(cross(r, p), n), c = dot(cross(p, q), n);
  if (!(a > 0 && b > 0 && c > 0)) return;
  if (dot(n, p) < 0) n = -n;
  std::array<Real, 4> w{};
  w[static_cast<std::size_t>(i)] = a, w[static_cast<std::size_t>(j)] = b, w[static_cast<std::size_t>(k)] = c;
  offer(best, s, w, &n);
}

bool try_tetrahedron(Candidate& best, const Simplex& s) {
  const Real3 &p = s.vertex[0].w, &q = s.vertex[1].w, &r = s.vertex[2].w, &t = s.vertex[3].w;
  const Real a = dot(q, cross(r, t)), b = -dot(p, cross(r, t)), c = dot(p, cross(q, t)),
             d = -dot(p, cross(q, r));
  const bool inside = (a > 0 && b > 0 && c > 0 && d > 0) || (a < 0 && b < 0 && c < 0 && d < 0);
  if (!inside) return false;
  const Real sum = a + b + c + d;
  best.weight = {a / sum, b / sum, c / sum, d / sum};
  best.nearest = best.weight[0] * p + best.weight[1] * q + best.weight[2] * r + best.weight[3] * t;
  best.outward = best.nearest;
  return true;
}

bool holds(const Simplex& s, const Vertex& v) {
  for (int i = 0; i < s.size; ++i) {
    const Vertex& u = s.vertex[static_cast<std::size_t>(i)];
    if (u.w.x == v.w.x && u.w.y == v.w.y && u.w.z == v.w.z) return true;
  }
  return false;
}

void keep_weighted(Simplex& s, const Candidate& c) {
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

void reduce(Simplex& s) {
  Candidate best;
  if (s.size == 4 && try_tetrahedron(best, s)) return keep_weighted(s, best);
  for (int i = 0; i < s.size; ++i) try_point(best, s, i);
  for (int i = 0; i < s.size; ++i)
    for (int j = i + 1; j < s.size; ++j) try_edge(best, s, i, j);
  for (int i = 0; i < s.size; ++i)
    for (int j = i + 1; j < s.size; ++j)
      for (int k = j + 1; k < s.size; ++k) try_triangle(best, s, i, j, k);
  keep_weighted(s, best);
}

GjkResult gjk(const Difference& d, std::span<const Real3> hints, Real target) {
  GjkResult r;
  Simplex& s = r.simplex;
  const auto ask = [&](const Real3& n) {
    const Vertex v = d.support(n);
    r.gap.raise(-d.width_above(v, n), n);
    return v;
  };
  for (const Real3& n : hints) {
    const Vertex v = ask(n);
    if (s.size == 4 || holds(s, v)) continue;
    s.vertex[static_cast<std::size_t>(s.size++)] = v;
    reduce(s);
  }
  if (s.size == 0) {
    s.vertex[0] = ask({1, 0, 0});
    s.size = 1;
    reduce(s);
  }
  int idle = 0;
  for (int i = 0; i < iteration_cap; ++i) {
    const CoreGap before = r.gap;
    // Weights sum to 1 within 8 units and the sum is rounded: 16 units of the extent.
    r.gap.lower(norm(s.nearest) + 16 * unit * d.extent + d.error);
    if (s.size == 4) return r.exit = GjkResult::Exit::encloses_origin, r;
    if (largest(s.outward) == 0) return r.exit = GjkResult::Exit::touches, r;
    const Vertex v = ask(-normalized(s.outward));
    if (r.gap.hi - r.gap.lo <= target) return r.exit = GjkResult::Exit::converged, r;
    if (holds(s, v)) return r.exit = GjkResult::Exit::no_progress, r;
    idle = r.gap.lo > before.lo || r.gap.hi < before.hi ? 0 : idle + 1;
    if (idle > patience) return r.exit = GjkResult::Exit::no_progress, r;
    s.vertex[static_cast<std::size_t>(s.size++)] = v;
    reduce(s);
  }
  return r;
}

}  // namespace touchstone::referee
