// Two boxes by the separating axis test (Gottschalk, Lin, Manocha 1996), in A's frame. Departures:
//
// * Projections on a cross axis e_i × b_j are computed from that vector itself instead of the identity b_j ×
//   b_m = b_l: every term then scales with the length of the axis, so nearly parallel edges lose no accuracy
//   and no epsilon is added to the matrix. An axis of length 0 is ignored.
// * The axis is orthogonal to e_i and b_j up to relative rounding (products of the same two numbers), so its
//   width is that of the true edge pair for boxes displaced by rounding only: the least of the 15 widths is
//   the depth to within the displacement, and every verdict beyond it is certain.
// * A face axis wins a tie within rounding, A's first: the normal of a stack is stable.
#pragma once

#include <array>
#include <utility>

#include "core/narrow/filtered/query.h"

namespace touchstone::narrow::filtered {

template <class R>
struct BoxPair {
  V3<R> ha, hb;
  Relative<R> at;
  R displacement;
  R size() const {
    return std::max(std::max(ha.maxCoeff(), hb.maxCoeff()), at.offset.template lpNorm<Eigen::Infinity>());
  }
};

/// The axis with the largest separation (least depth): 0-2 A's faces, 3-5 B's, 6 + 3i + j edges i of A and j
/// of B.
template <class R>
struct BoxAxis {
  Found found = Found::unsure;
  int index = 0;
  R separation = -std::numeric_limits<R>::infinity();
  V3<R> normal;  // A's frame, A to B
};

namespace detail {

// Edge axis e_i × b_j: separation times length, the length's square and its 1-norm.
template <class R>
struct EdgeAxis {
  R s, length_sq, length_1;
};

/// Of the cross product of B's axes j and j + 1: the coordinate along e_i without its sign, by 3i + j. The
/// two axes on e_i × b_j and e_i × b_(j + 1) have it in common.
template <class R>
using EdgeWidths = std::array<R, 9>;

template <int i, int j, class R>
R edge_width(const M3<R>& m) {
  constexpr int k = (i + 1) % 3, l = (i + 2) % 3, next = (j + 1) % 3;
  return std::abs(m(l, next) * m(k, j) - m(k, next) * m(l, j));
}

template <int i, int j, class R>
EdgeAxis<R> edge_axis(const BoxPair<R>& p, const EdgeWidths<R>& width) {
  constexpr int k = (i + 1) % 3, l = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  // n_k = −m(l, j), n_l = m(k, j)
  const R x = p.at.b_to_a(k, j), y = p.at.b_to_a(l, j), ax = std::abs(x), ay = std::abs(y);
  const R radius_a = p.ha[k] * ay + p.ha[l] * ax;
  const R radius_b = p.hb[j1] * width[std::size_t{3 * i + j}] + p.hb[j2] * width[std::size_t{3 * i + j2}];
  return {std::abs(p.at.offset[l] * x - p.at.offset[k] * y) - (radius_a + radius_b), x * x + y * y, ax + ay};
}

/// f(axis of edges i, j, 3i + j) for each of the nine, until one returns true; whether one has.
template <class R, class F>
bool any_edge_axis(const BoxPair<R>& p, F&& f) {
  return [&]<int... e>(std::integer_sequence<int, e...>) {
    const EdgeWidths<R> width{edge_width<e / 3, e % 3>(p.at.b_to_a)...};
    return (f(edge_axis<e / 3, e % 3>(p, width), e) || ...);
  }
  (std::make_integer_sequence<int, 9>());
}

template <class R>
V3<R> edge_normal(const BoxPair<R>& p, int i, int j) {
  V3<R> n = V3<R>::Unit(i).cross(p.at.b_to_a.col(j)).normalized();
  return n.dot(p.at.offset) < 0 ? V3<R>(-n) : n;
}

/// Separations along the six face axes.
template <class R>
std::array<R, 6> face_separations(const BoxPair<R>& p) {
  const M3<R>& m = p.at.b_to_a;
  const V3<R>& t = p.at.offset;
  std::array<R, 6> s;
  for (int i = 0; i < 3; ++i)
    s[static_cast<std::size_t>(i)] =
        std::abs(t[i]) -
        (p.ha[i] + (std::abs(m(i, 0)) * p.hb[0] + std::abs(m(i, 1)) * p.hb[1] + std::abs(m(i, 2)) * p.hb[2]));
  for (int j = 0; j < 3; ++j)
    s[static_cast<std::size_t>(3 + j)] =
        std::abs(t[0] * m(0, j) + t[1] * m(1, j) + t[2] * m(2, j)) -
        (p.hb[j] + (std::abs(m(0, j)) * p.ha[0] + std::abs(m(1, j)) * p.ha[1] + std::abs(m(2, j)) * p.ha[2]));
  return s;
}

}  // namespace detail

template <class R>
BoxPair<R> box_pair(const Shape& sa, const RoundedPose<R>& a, const Shape& sb, const RoundedPose<R>& b) {
  BoxPair<R> p{std::get_if<Box>(&sa)->half_extents.template cast<R>(),
               std::get_if<Box>(&sb)->half_extents.template cast<R>(), relative(a, b), 0};
  // 1-norms bound the lengths in query.h's analysis and need no square root.
  p.displacement = displacement_of<R>(p.ha.sum(), p.hb.sum(), p.at.offset.cwiseAbs().sum());
  return p;
}

/// The verdict only; early exit at the first axis that separates.
template <class R>
Found boxes_meet(const BoxPair<R>& p) {
  const auto faces = detail::face_separations(p);
  R most = faces[0];
  for (const R s : faces) most = std::max(most, s);
  if (most > p.displacement) return Found::apart;
  bool certain = most < -p.displacement;
  const auto edge = [&](const detail::EdgeAxis<R>& e, int) {
    certain &= e.s <= -p.displacement * e.length_1;
    return e.s > p.displacement * e.length_1;
  };
  if (detail::any_edge_axis(p, edge)) return Found::apart;
  return certain ? Found::meeting : Found::unsure;
}

/// The axis of least depth; `apart` as soon as one separates (then its separation is a lower bound only).
template <class R>
BoxAxis<R> least_axis(const BoxPair<R>& p) {
  const auto faces = detail::face_separations(p);
  const R tie = p.displacement / 16;
  BoxAxis<R> best;
  for (int i = 0; i < 6; ++i)
    if (const R s = faces[static_cast<std::size_t>(i)];
        s > best.separation + (best.index < 3 && i >= 3 ? tie : 0)) {
      best.separation = s;
      best.index = i;
    }
  if (best.separation > p.displacement) {
    best.found = Found::apart;
    return best;
  }
  detail::any_edge_axis(p, [&](const detail::EdgeAxis<R>& e, int index) {
    const R goal = best.separation + tie;
    // Tests s/|n| > goal without a square root, for all cases of sign.
    const bool better = goal < 0 ? (e.s > 0 || e.s * e.s < goal * goal * e.length_sq)
                                 : (e.s > 0 && e.s * e.s > goal * goal * e.length_sq);
    if (better && e.length_sq > 0) {
      best.separation = e.s / std::sqrt(e.length_sq);
      best.index = 6 + index;
    }
    return false;
  });
  best.found = decide(best.separation, p.displacement);
  if (best.index < 3)
    best.normal = V3<R>::Unit(best.index) * (p.at.offset[best.index] < 0 ? R(-1) : R(1));
  else if (best.index < 6)
    best.normal = p.at.b_to_a.col(best.index - 3) *
                  (p.at.b_to_a.col(best.index - 3).dot(p.at.offset) < 0 ? R(-1) : R(1));
  else
    best.normal = detail::edge_normal(p, (best.index - 6) / 3, (best.index - 6) % 3);
  return best;
}

}  // namespace touchstone::narrow::filtered
