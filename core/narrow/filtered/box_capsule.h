// A box and a capsule without a search, in the box's frame: a segment c + t·d, |t| <= h, and the box |x_k| <=
// H_k.
//
// * Apart: the squared distance of c + t·d to the box is Σ max(|x_k| − H_k, 0)², convex and quadratic between
//   the six values of t at which the segment crosses a face's plane. Its derivative is evaluated there and is
//   linear in between, so the foot is found without iteration. The difference of the feet is then made
//   orthogonal to the segment, among the coordinates in which the foot is outside.
// * Meeting: the facets of the sum of a box and a segment are the box's faces and parallelograms of an edge
//   and the segment, so the largest of six separations is minus the depth (as in box_box.h, cross axes from
//   the vector itself).
//
// A direction is trusted only as far as its support planes prove it; their shortfall from the distance is
// added to the bound. Outcomes: a value within its bound, the verdict only, or false when neither form is
// accurate enough (nearly parallel features within rounding of touching), in which case the search answers.
#pragma once

#include <algorithm>

#include "core/narrow/filtered/closed_forms.h"

namespace touchstone::narrow::filtered {

template <class R>
struct BoxSegment {
  V3<R> half, c, d;  // d is a unit vector
  R h, error;        // error: displacement of both by rounding

  V3<R> at(R t) const { return c + t * d; }
  V3<R> outside(const V3<R>& x) const { return x - x.cwiseMax(-half).cwiseMin(half); }
  R slope(R t) const { return d.dot(outside(at(t))); }
  /// Separation of the support planes along a unit n, box to segment.
  R separation(const V3<R>& n) const { return n.dot(c) - n.cwiseAbs().dot(half) - std::abs(n.dot(d)) * h; }
};

/// n points from the box to the segment; box + gap·n = segment, for the cores.
template <class R>
struct BoxSegmentGap {
  R gap = 0, bound = std::numeric_limits<R>::infinity();
  V3<R> n, box, segment;
};

namespace detail {

template <class R>
R nearest_parameter(const BoxSegment<R>& p) {
  R lo = -p.h, hi = p.h, at_lo = p.slope(lo), at_hi = p.slope(hi);
  if (!(at_lo < 0)) return lo;
  if (!(at_hi > 0)) return hi;
  for (int k = 0; k < 3; ++k) {
    if (p.d[k] == 0) continue;
    const R inverse = 1 / p.d[k];
    for (const R plane : {-p.half[k], p.half[k]}) {
      const R t = (plane - p.c[k]) * inverse;
      if (!(t > lo && t < hi)) continue;
      const R s = p.slope(t);
      if (s == 0) return t;
      (s < 0 ? lo : hi) = t;
      (s < 0 ? at_lo : at_hi) = s;
    }
  }
  return std::clamp(lo - at_lo * ((hi - lo) / (at_hi - at_lo)), lo, hi);
}

// Removes the component along the segment from v, among the coordinates in which v is outside the box.
template <class R>
void remove_along_segment(const BoxSegment<R>& p, V3<R>& v) {
  V3<R> along = p.d;
  for (int k = 0; k < 3; ++k)
    if (v[k] == 0) along[k] = 0;
  const R square = along.squaredNorm();
  // Along a face, or nearly parallel to an edge: only rounding is left.
  if (!(square > R(tolerance::parallel_sine_sq))) return;
  v -= along * (along.dot(v) / square);
  v -= along * (along.dot(v) / square);
}

template <class R>
BoxSegmentGap<R> apart(const BoxSegment<R>& p) {
  BoxSegmentGap<R> g;
  const R t = nearest_parameter(p);
  g.segment = p.at(t);
  V3<R> v = p.outside(g.segment);
  g.box = g.segment - v;
  if (std::abs(t) < p.h) remove_along_segment(p, v);
  g.gap = std::sqrt(v.squaredNorm());
  if (!(g.gap > 0)) return g;
  g.n = detail::direction<R>(v, g.gap);
  g.bound = p.error + std::max<R>(0, g.gap - p.separation(g.n));
  return g;
}

// Index of the axis: 0-2 the box's faces, 3-5 its edges crossed with the segment.
template <class R>
int least_depth(const BoxSegment<R>& p, R& most) {
  int best = 0;
  most = -std::numeric_limits<R>::infinity();
  for (int k = 0; k < 3; ++k)
    if (const R s = std::abs(p.c[k]) - p.half[k] - std::abs(p.d[k]) * p.h; s > most) {
      most = s;
      best = k;
    }
  const R tie = p.error / 16;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const R x = p.d[i], y = p.d[j], length_sq = x * x + y * y;
    if (!(length_sq > 0)) continue;
    const R s = (std::abs(p.c[j] * x - p.c[i] * y) - (p.half[i] * std::abs(y) + p.half[j] * std::abs(x))) /
                std::sqrt(length_sq);
    if (s > most + (best < 3 ? tie : 0)) {
      most = s;
      best = 3 + k;
    }
  }
  return best;
}

// The deepest end or, if that is not above the face, the nearest point that is.
template <class R>
void meet_face(const BoxSegment<R>& p, int k, BoxSegmentGap<R>& g) {
  const R side = p.c[k] < 0 ? R(-1) : R(1), tolerance = p.error / 4;
  g.n = V3<R>::Unit(k) * side;
  R lo = -p.h, hi = p.h;
  for (const int j : {(k + 1) % 3, (k + 2) % 3}) {
    if (std::abs(p.d[j]) * p.h <= tolerance) continue;
    const R a = (-p.half[j] - p.c[j]) / p.d[j], b = (p.half[j] - p.c[j]) / p.d[j];
    lo = std::max(lo, std::min(a, b));
    hi = std::min(hi, std::max(a, b));
  }
  const R deepest = side * p.d[k] > 0 ? -p.h : p.h;
  // Parallel to the face: takes the middle, which is stable.
  const bool level = std::abs(p.d[k]) * p.h <= tolerance;
  g.segment = p.at(level ? (lo + hi) / 2 : (std::abs(lo - deepest) < std::abs(hi - deepest) ? lo : hi));
  g.box = g.segment.cwiseMax(-p.half).cwiseMin(p.half);
  g.box[k] = side * p.half[k];
}

template <class R>
void meet_edge(const BoxSegment<R>& p, int k, BoxSegmentGap<R>& g) {
  g.n = V3<R>::Unit(k).cross(p.d).normalized();
  if (g.n.dot(p.c) < 0) g.n = -g.n;
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  g.box[i] = std::copysign(p.half[i], g.n[i]);
  g.box[j] = std::copysign(p.half[j], g.n[j]);
  const R square = p.d[i] * p.d[i] + p.d[j] * p.d[j];
  const R t = ((g.box[i] - p.c[i]) * p.d[i] + (g.box[j] - p.c[j]) * p.d[j]) / square;
  g.segment = p.at(std::clamp(t, -p.h, p.h));
  g.box[k] = std::clamp(g.segment[k], -p.half[k], p.half[k]);
}

// `far`: the distance of two of their points, for bodies that may be apart by less than rounding.
template <class R>
BoxSegmentGap<R> meeting(const BoxSegment<R>& p, R far) {
  BoxSegmentGap<R> g;
  const int axis = least_depth(p, g.gap);
  if (g.gap > p.error) return g;
  g.bound = p.error + (g.gap > -p.error ? std::max<R>(0, far - g.gap) : R(0));
  if (axis < 3)
    meet_face(p, axis, g);
  else
    meet_edge(p, axis - 3, g);
  return g;
}

// Whether contact_patch may give more than the point halfway: the capsule lies along a face or an edge.
template <class R>
bool lies_along(const BoxSegment<R>& p, const V3<R>& n, R depth, R tolerance) {
  if (std::abs(n.dot(p.d)) * 2 * p.h > depth + tolerance) return false;
  int free = 0, last = 0;
  for (int k = 0; k < 3; ++k)
    if (2 * std::abs(n[k]) * p.half[k] <= tolerance) {
      ++free;
      last = k;
    }
  return free >= 2 || (free == 1 && 1 - p.d[last] * p.d[last] < R(tolerance::parallel_sine_sq));
}

}  // namespace detail

template <class R>
struct BoxCapsule {
  M3<R> to_world;
  BoxSegment<R> cores;
  R radius, scale;
};

template <class R>
BoxCapsule<R> box_capsule(const Shape& sa, const RoundedPose<R>& a, const Shape& sb,
                          const RoundedPose<R>& b) {
  const auto& capsule = *std::get_if<Capsule>(&sb);
  BoxCapsule<R> r{matrix(a), {}, static_cast<R>(capsule.radius), 0};
  BoxSegment<R>& p = r.cores;
  const V3<R> offset = b.t - a.t;
  p.half = std::get_if<Box>(&sa)->half_extents.template cast<R>();
  p.h = static_cast<R>(capsule.half_height);
  p.c = r.to_world.transpose() * offset;
  p.d = r.to_world.transpose() * axis_z(b);
  p.error = displacement_of<R>(p.half.norm(), p.h, p.c.norm()) + rounding::ball * u<R> * r.radius;
  r.scale = std::max(std::max(detail::largest(p.half), r.radius + p.h), detail::largest(offset) / 2);
  return r;
}

/// True: `out` is set in the box's frame, to the required accuracy; false: undecided.
template <class R>
bool solve(const BoxCapsule<R>& q, Asked asked, Answer<R>& out) {
  BoxSegmentGap<R> g = detail::apart(q.cores);
  const R far = g.gap;
  if (!(g.bound <= 2 * q.cores.error)) g = detail::meeting(q.cores, far);
  out.gap = g.gap - q.radius;
  out.bound = g.bound;
  out.found = decide(out.gap, out.bound);
  if (asked == Asked::overlap && out.found != Found::touching) return true;
  if (!accepted(g.bound, q.scale)) return false;
  out.normal = g.n;
  out.a = g.box;
  out.b = g.segment - q.radius * g.n;
  return std::abs((out.b - out.a).norm() - std::abs(out.gap)) <= accuracy(q.scale) / 4;
}

}  // namespace touchstone::narrow::filtered
