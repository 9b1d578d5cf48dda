// Closest point to the origin of a simplex of one to four points: every face is tried and the nearest
// admissible one is taken. This is slower than walking Voronoi regions, but a nearly flat face can only be
// skipped, never mistaken for another region, and the chosen distance never exceeds that of any edge (the
// failure of Johnson's recursion that Montanari, Petrinic, Barbieri 2017 describe cannot occur).
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/math/wide.h"

namespace touchstone::narrow {

template <class R>
struct ClosestPoint {
  V3<R> point = V3<R>::Zero();
  std::array<R, 4> weight{};  // barycentric; zero for points not involved
  R dist_sq = std::numeric_limits<R>::infinity();
  bool encloses = false;  // a tetrahedron with the origin inside or on its boundary
};

namespace detail {

// A face of higher dimension wins a tie within rounding: the foot on an edge may reduce the distance by less
// than an ulp and yet rotate the direction by 1e-12, and the support plane needs that accuracy.
template <class R>
inline constexpr R tie = 1 + 8 * std::numeric_limits<R>::epsilon();

template <class R>
void try_vertex(const V3<R>* const* p, int i, ClosestPoint<R>& best) {
  const R d = p[i]->squaredNorm();
  if (!(d < best.dist_sq)) return;
  best.point = *p[i];
  best.dist_sq = d;
  best.weight = {};
  best.weight[static_cast<std::size_t>(i)] = 1;
}

template <class R>
void try_edge(const V3<R>* const* p, int i, int j, ClosestPoint<R>& best) {
  const V3<R> d = *p[j] - *p[i];
  const R len_sq = d.squaredNorm(), t = -p[i]->dot(d);
  if (!(t > 0 && t < len_sq)) return;
  const R s = t / len_sq;
  // Makes x orthogonal to the edge up to its own rounding instead of that of the ends: an edge may be 1e10
  // times longer than the distance, and an angular error of the normal costs half the edge times that angle.
  V3<R> x = *p[i] + d * s;
  x -= d * (x.dot(d) / len_sq);
  const R dist_sq = x.squaredNorm();
  if (!(dist_sq <= best.dist_sq * tie<R>)) return;
  best.point = x;
  best.dist_sq = dist_sq;
  best.weight = {};
  best.weight[static_cast<std::size_t>(i)] = 1 - s;
  best.weight[static_cast<std::size_t>(j)] = s;
}

/// Normal of a triangle, counter-clockwise, not normalised: the cross product of the two shorter edges, made
/// orthogonal to the longest one. For a needle, the component of the cross product along the needle is as
/// large as the rounding of the edges' product, which would tilt a plane 1e7 times longer than wide by 1e7
/// ulp. What remains is a rotation about the needle, which moves its points only within rounding.
template <class R>
V3<R> triangle_normal(const V3<R>& a, const V3<R>& b, const V3<R>& c) {
  const V3<R> ab = b - a, bc = c - b, ca = a - c;
  const R lab = ab.squaredNorm(), lbc = bc.squaredNorm(), lca = ca.squaredNorm();
  const auto against = [](const V3<R>& n, const V3<R>& longest, R length_sq) {
    return length_sq > 0 ? V3<R>(n - longest * (n.dot(longest) / length_sq)) : n;
  };
  if (lab >= lbc && lab >= lca) return against(bc.cross(ca), ab, lab);
  return lbc >= lca ? against(ca.cross(ab), bc, lbc) : against(ab.cross(bc), ca, lca);
}

// Writes the point as normal·(a·normal)/|normal|²: its direction is that of the plane even when its length is
// far below the rounding of a weighted sum of the corners.
template <class R>
void try_triangle(const V3<R>* const* p, int i, int j, int k, ClosestPoint<R>& best) {
  const V3<R>&a = *p[i], &b = *p[j], &c = *p[k];
  const V3<R> n = triangle_normal<R>(a, b, c);
  const R nn = n.squaredNorm();
  const R flat = 16 * std::numeric_limits<R>::epsilon();
  if (!(nn > flat * flat * (b - a).squaredNorm() * (c - a).squaredNorm())) return;
  const R wa = n.dot(b.cross(c)), wb = n.dot(c.cross(a)), wc = n.dot(a.cross(b));
  if (!(wa > 0 && wb > 0 && wc > 0)) return;
  const R aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
  const V3<R>& nearest = aa <= bb && aa <= cc ? a : (bb <= cc ? b : c);
  const V3<R> x = n * (nearest.dot(n) / nn);
  const R dist_sq = x.squaredNorm();
  if (!(dist_sq <= best.dist_sq * tie<R>)) return;
  best.point = x;
  best.dist_sq = dist_sq;
  best.weight = {};
  // Iterative refinement: the weights of a needle are accurate only to its aspect ratio. The residual in its
  // plane corrects them until the weighted sum of the corners is the foot to within rounding.
  R la = wa / (wa + wb + wc), lb = wb / (wa + wb + wc), lc = wc / (wa + wb + wc);
  for (int step = 0; step < 2; ++step) {
    const V3<R> rest = x - (la * a + lb * b + lc * c);
    const R da = n.dot(rest.cross(b - c)) / nn, db = n.dot(rest.cross(c - a)) / nn;
    la += da;
    lb += db;
    lc -= da + db;
  }
  la = std::max<R>(la, 0);
  lb = std::max<R>(lb, 0);
  lc = std::max<R>(lc, 0);
  const R sum = la + lb + lc;
  best.weight[static_cast<std::size_t>(i)] = la / sum;
  best.weight[static_cast<std::size_t>(j)] = lb / sum;
  best.weight[static_cast<std::size_t>(k)] = lc / sum;
}

// Whether the origin is strictly inside: on the inner side of each face by the sign of a determinant.
template <class R>
bool tetrahedron_encloses(const V3<R>* const* p) {
  static constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  for (const auto& f : faces) {
    const V3<R> n = (*p[f[1]] - *p[f[0]]).cross(*p[f[2]] - *p[f[0]]);
    const R apex = n.dot(*p[f[3]] - *p[f[0]]), origin = -n.dot(*p[f[0]]);
    if (!(apex * origin > 0)) return false;
  }
  return true;
}

}  // namespace detail

template <class R>
ClosestPoint<R> closest_to_origin(std::span<const V3<R>* const> points) {
  ClosestPoint<R> best;
  const int n = static_cast<int>(points.size());
  const auto* p = points.data();
  if (n == 4 && detail::tetrahedron_encloses<R>(p)) {
    best.encloses = true;
    best.dist_sq = 0;
    return best;
  }
  for (int i = 0; i < n; ++i) detail::try_vertex<R>(p, i, best);
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) detail::try_edge<R>(p, i, j, best);
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k) detail::try_triangle<R>(p, i, j, k, best);
  return best;
}

}  // namespace touchstone::narrow
