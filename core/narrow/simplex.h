// The point of a simplex nearest to the origin, for an iteration whose bounds come from support planes: a
// wrong choice here costs an iteration, never correctness. Feet are written as multiples of the face's
// normal, and made orthogonal to the edge, so that their direction is right even when they are far shorter
// than the rounding of the corners.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math/wide.h"
#include "core/narrow/rounding.h"
#include "core/shape/feature.h"

namespace touchstone::narrow {

/// A point w of B − A and the point a of A that generates it: b = w + a.
template <class R>
struct Vertex {
  V3<R> w = V3<R>::Zero(), a = V3<R>::Zero();
};

template <class R>
struct Simplex {
  std::array<Vertex<R>, 4> p{};
  std::array<R, 4> weight{};
  int size = 0;
};

/// Foot of the origin and the corners that support it.
template <class R>
struct Foot {
  V3<R> point = V3<R>::Zero();
  R dist_sq = std::numeric_limits<R>::infinity();
  std::array<int, 3> corner{};
  std::array<R, 3> weight{};
  int size = 0;
};

using convex::triangle_normal;

/// The same, made orthogonal to the longest edge. For a needle, the component of the cross product along the
/// needle is as large as the rounding of the edges' product, which would tilt a plane 1e7 times longer than
/// wide by 1e7 ulp. What remains is a rotation about the needle, which moves its points only within rounding.
template <class R>
V3<R> upright_normal(const V3<R>& a, const V3<R>& b, const V3<R>& c) {
  const V3<R> ab = b - a, bc = c - b, ca = a - c;
  const R lab = ab.squaredNorm(), lbc = bc.squaredNorm(), lca = ca.squaredNorm();
  const V3<R>& longest = lab >= lbc && lab >= lca ? ab : (lbc >= lca ? bc : ca);
  const R length_sq = longest.squaredNorm();
  const V3<R> n = triangle_normal(a, b, c);
  return length_sq > 0 ? V3<R>(n - longest * (n.dot(longest) / length_sq)) : n;
}

namespace detail {

template <class R>
void take_corner(const Simplex<R>& s, int i, Foot<R>& best) {
  const V3<R>& w = s.p[static_cast<std::size_t>(i)].w;
  const R d = w.squaredNorm();
  if (!(d < best.dist_sq)) return;
  best.point = w;
  best.dist_sq = d;
  best.size = 1;
  best.corner[0] = i;
  best.weight[0] = 1;
}

template <class R>
void take_edge(const Simplex<R>& s, int i, int j, Foot<R>& best) {
  const V3<R>&p = s.p[static_cast<std::size_t>(i)].w, &q = s.p[static_cast<std::size_t>(j)].w;
  const V3<R> d = q - p;
  const R len_sq = d.squaredNorm(), t = -p.dot(d);
  if (!(t > 0)) return take_corner(s, i, best);
  if (!(t < len_sq)) return take_corner(s, j, best);
  const R inverse = 1 / len_sq, k = t * inverse;
  V3<R> x = p + d * k;
  x -= d * (x.dot(d) * inverse);
  const R dist_sq = x.squaredNorm();
  if (!(dist_sq < best.dist_sq)) return;
  best.point = x;
  best.dist_sq = dist_sq;
  best.size = 2;
  best.corner[0] = i;
  best.corner[1] = j;
  best.weight[0] = 1 - k;
  best.weight[1] = k;
}

/// `careful`: a nearly flat triangle is replaced by its edges, and the normal is upright. Extended precision
/// decides what doubles could not, and cannot afford a wrong face; doubles can, and it would cost them time.
template <bool careful, class R>
void take_triangle(const Simplex<R>& s, int i, int j, int k, Foot<R>& best) {
  const V3<R>&a = s.p[static_cast<std::size_t>(i)].w, &b = s.p[static_cast<std::size_t>(j)].w,
        &c = s.p[static_cast<std::size_t>(k)].w;
  const V3<R> n = careful ? upright_normal(a, b, c) : triangle_normal(a, b, c);
  const R flat = rounding::flat_triangle * std::numeric_limits<R>::epsilon();
  const bool skip =
      careful && !(n.squaredNorm() > flat * flat * (b - a).squaredNorm() * (c - a).squaredNorm());
  const R wa = n.dot(b.cross(c)), wb = n.dot(c.cross(a)), wc = n.dot(a.cross(b)), sum = wa + wb + wc;
  if (!skip && wa > 0 && wb > 0 && wc > 0) {
    const R aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
    const V3<R>& nearest = aa <= bb && aa <= cc ? a : (bb <= cc ? b : c);
    const V3<R> x = n * (nearest.dot(n) / n.squaredNorm());
    const R dist_sq = x.squaredNorm();
    if (!(dist_sq < best.dist_sq)) return;
    best.point = x;
    best.dist_sq = dist_sq;
    best.size = 3;
    const R share = 1 / sum;
    best.corner = {i, j, k};
    best.weight = {wa * share, wb * share, wc * share};
    return;
  }
  if (skip || !(wa > 0)) take_edge(s, j, k, best);
  if (skip || !(wb > 0)) take_edge(s, k, i, best);
  if (skip || !(wc > 0)) take_edge(s, i, j, best);
}

/// Considers the faces whose outer side contains the origin. If there are none, the tetrahedron encloses the
/// origin, and `margin` is its least distance to a plane, less the possible rounding of the normal. The face
/// opposite the newest (last) corner is tested last, and only if the others have not improved on `last_sq`
/// (skipping it entirely does not work: near triangles, the iteration stalls).
template <bool careful, class R>
bool take_tetrahedron(const Simplex<R>& s, R last_sq, Foot<R>& best, R& margin) {
  using std::abs;
  using std::sqrt;
  static constexpr int faces[4][4] = {{1, 2, 3, 0}, {2, 0, 3, 1}, {0, 1, 3, 2}, {0, 2, 1, 3}};
  bool enclosed = true;
  std::array<R, 4> height, square;  // height of the origin times |normal|, less rounding
  for (int i = 0; i < 4; ++i) {
    if (i == 3 && best.dist_sq < last_sq) break;
    const int* f = faces[i];
    const auto w = [&](int k) -> const V3<R>& { return s.p[static_cast<std::size_t>(f[k])].w; };
    const V3<R> e1 = w(1) - w(0), e2 = w(2) - w(0), e3 = w(3) - w(0), n = e1.cross(e2);
    const R apex = n.dot(e3), origin = -n.dot(w(0));
    bool outside = !(apex * origin > 0);
    if (!outside) {
      const R error = rounding::volume * std::numeric_limits<R>::epsilon() * e1.template lpNorm<1>() *
                      e2.template lpNorm<1>() * std::max(w(0).template lpNorm<1>(), e3.template lpNorm<1>());
      // The sign of a sliver is noise, but then the origin is farther from the plane than the apex is.
      outside = abs(origin) > abs(apex) + error;
      height[static_cast<std::size_t>(i)] = abs(origin) - error;
      square[static_cast<std::size_t>(i)] = n.squaredNorm();
    }
    if (!outside) continue;
    enclosed = false;
    take_triangle<careful>(s, f[0], f[1], f[2], best);
  }
  if (enclosed) {
    margin = std::numeric_limits<R>::infinity();
    for (std::size_t i = 0; i < 4; ++i) margin = std::min<R>(margin, height[i] / sqrt(square[i]));
  }
  // Rounding rejected every face: fall back to the last one.
  if (!enclosed && best.size == 0) take_triangle<careful>(s, 0, 2, 1, best);
  return enclosed;
}

}  // namespace detail

/// Reduces the simplex to the corners that support its nearest point; true: it encloses the origin
/// (unchanged). dist_sq: in, of the last nearest point; out, of this one.
template <bool careful = false, class R>
bool reduce(Simplex<R>& s, V3<R>& v, R& dist_sq, R& margin) {
  Foot<R> foot{};
  if (s.size == 4 && detail::take_tetrahedron<careful>(s, dist_sq, foot, margin)) return true;
  if (s.size == 3) detail::take_triangle<careful>(s, 0, 1, 2, foot);
  if (s.size == 2) detail::take_edge(s, 0, 1, foot);
  if (s.size == 1) detail::take_corner(s, 0, foot);
  std::array<Vertex<R>, 3> kept;
  for (std::size_t k = 0; k < 3; ++k) kept[k] = s.p[static_cast<std::size_t>(foot.corner[k])];
  s.size = foot.size;
  v = foot.point;
  dist_sq = foot.dist_sq;
  for (std::size_t k = 0; k < 3; ++k) {
    s.p[k] = kept[k];
    s.weight[k] = foot.weight[k];
  }
  return false;
}

/// Iterative refinement of a triangle's weights: those of a needle are accurate only to its aspect ratio. The
/// residual in its plane corrects them until the weighted sum of the corners is the foot to within rounding.
template <class R>
void refine_weights(const V3<R>& a, const V3<R>& b, const V3<R>& c, const V3<R>& foot, R* weight) {
  const V3<R> n = upright_normal(a, b, c);
  const R nn = n.squaredNorm();
  if (!(nn > 0)) return;
  for (int step = 0; step < 2; ++step) {
    const V3<R> rest = foot - (weight[0] * a + weight[1] * b + weight[2] * c);
    const R da = n.dot(rest.cross(b - c)) / nn, db = n.dot(rest.cross(c - a)) / nn;
    weight[0] += da;
    weight[1] += db;
    weight[2] -= da + db;
  }
  R sum = 0;
  for (int k = 0; k < 3; ++k) {
    weight[k] = std::max<R>(weight[k], 0);
    sum += weight[k];
  }
  for (int k = 0; k < 3; ++k) weight[k] /= sum;
}

}  // namespace touchstone::narrow
