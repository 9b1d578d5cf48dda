// Spheres, capsules and a box, without a search. Each closed form proposes nearest points of the cores and a
// direction. The direction's own support planes show by how much, beyond rounding of the input, it falls
// short of being the normal, and that shortfall is added to the bound. Coincident centres have a direction by
// definition: any direction orthogonal to the segments is a minimum; x or an orthogonal of the axis is
// returned.
#pragma once

#include <algorithm>

#include "core/narrow/filtered/query.h"

namespace touchstone::narrow::filtered {

namespace detail {

template <class R>
R largest(const V3<R>& v) {
  return std::max(std::max(std::abs(v[0]), std::abs(v[1])), std::abs(v[2]));
}

/// Below this, the square of a length comes close to underflow in float.
template <class R>
inline constexpr R least_length = R(1e-15);

/// v/|v| for |v| > 0. In float, the square of a length may underflow where the length does not.
template <class R>
V3<R> direction(const V3<R>& v, R length) {
  return length > least_length<R> ? V3<R>(v * (1 / length)) : V3<R>(v.stableNormalized());
}

/// Whether a form may square lengths of pairs of this size: no square overflows, and one that underflows is
/// that of a length beyond the last digit of the size. Where it may not, the form is unsure.
/// Tested by: tests/core "signed distances do not depend on the unit of length".
template <class R>
bool squares_hold(R size) {
  constexpr bool single = sizeof(R) == sizeof(float);
  constexpr R least = single ? 0x1p-40 : 0x1p-450, most = single ? 0x1p+60 : 0x1p+500;  // lengths
  return size > least && size < most;
}

/// Whether the verdict is certain without a value; sets it if so.
template <class R>
bool verdict(Answer<R>& s, R gap, R error) {
  s.bound = error;
  const Found found = decide(gap, error);
  if (found == Found::touching) return false;
  s.found = found;
  return true;
}

/// From core points pa, pb (b − a = dist·n) to the rounded bodies; `scale` as in accuracy().
template <class R>
void inflate(Answer<R>& s, R dist, const V3<R>& n, const V3<R>& pa, const V3<R>& pb, R ra, R rb, R error,
             R scale) {
  s.gap = dist - (ra + rb);
  s.normal = n;
  s.bound = error;
  s.a = pa + ra * n;
  s.b = pb - rb * n;
  s.found = accepted(error, scale) ? decide(s.gap, error) : Found::unsure;
}

}  // namespace detail

template <class R>
void sphere_sphere(const Shape& sa, const Pose& a, const Shape& sb, const Pose& b, Asked asked,
                   Answer<R>& out) {
  const R ra = static_cast<R>(std::get_if<Sphere>(&sa)->radius),
          rb = static_cast<R>(std::get_if<Sphere>(&sb)->radius);
  const V3<R> d = b.translation.cast<R>() - a.translation.cast<R>();
  if (!detail::squares_hold(std::max(std::max(ra, rb), detail::largest(d)))) return;
  const R dist = std::sqrt(d.squaredNorm()), error = u<R> * (8 * dist + 4 * (ra + rb));
  if (asked == Asked::overlap && detail::verdict(out, dist - (ra + rb), error)) return;
  detail::inflate<R>(out, dist, dist > 0 ? detail::direction<R>(d, dist) : V3<R>::UnitX(), V3<R>::Zero(), d,
                     ra, rb, error, std::max(std::max(ra, rb), dist * offset_share<R>));
}

template <class R>
void sphere_box(const Shape& sa, const Pose& pa, const Shape& sb, const Pose& pb, Asked asked,
                Answer<R>& out) {
  const R r = static_cast<R>(std::get_if<Sphere>(&sa)->radius);
  const RoundedPose<R> b = rounded_pose<R>(pb);
  const V3<R> h = std::get_if<Box>(&sb)->half_extents.template cast<R>(), d = b.t - pa.translation.cast<R>();
  if (!detail::squares_hold(std::max(std::max(r, detail::largest(h)), detail::largest(d)))) return;
  const M3<R> m = matrix(b);
  V3<R> p;
  for (int k = 0; k < 3; ++k) p[k] = -(m(0, k) * d[0] + m(1, k) * d[1] + m(2, k) * d[2]);
  const V3<R> q = p.cwiseMax(-h).cwiseMin(h), v = q - p;
  // The 1-norm bounds the length and needs no square root.
  const R far = d.template lpNorm<1>(), error = u<R> * (24 * far + 4 * r + 2 * detail::largest(h));
  const R dist = std::sqrt(v.squaredNorm());
  if (asked == Asked::overlap && detail::verdict(out, dist - r, error)) return;
  if (dist > 0)
    return detail::inflate<R>(out, dist, m * detail::direction<R>(v, dist), V3<R>::Zero(), m * q + d, r, R(0),
                              error, std::max(std::max(r, detail::largest(h)), detail::largest(d) / 2));
  int axis = 0;
  const R depth = (h - p.cwiseAbs()).minCoeff(&axis);
  const V3<R> n = m.col(axis) * (p[axis] < 0 ? R(1) : R(-1));
  out.gap = -depth - r;
  out.normal = n;
  out.a = r * n;
  out.b = -depth * n;
  out.bound = error;
  out.found = decide(out.gap, error);
}

template <class R>
void sphere_capsule(const Shape& sa, const Pose& pa, const Shape& sb, const Pose& pb, Asked asked,
                    Answer<R>& out) {
  const auto& capsule = *std::get_if<Capsule>(&sb);
  const R ra = static_cast<R>(std::get_if<Sphere>(&sa)->radius), rb = static_cast<R>(capsule.radius);
  const R h = static_cast<R>(capsule.half_height);
  const RoundedPose<R> b = rounded_pose<R>(pb);
  const V3<R> axis = axis_z(b), d = b.t - pa.translation.cast<R>();
  if (!detail::squares_hold(std::max(std::max(ra, rb + h), detail::largest(d)))) return;
  const R along = -d.dot(axis), s = std::clamp(along, -h, h);
  const V3<R> q = d + s * axis;
  const R error = u<R> * (16 * d.template lpNorm<1>() + 24 * h + 4 * (ra + rb));
  // A foot displaced by the rounding of `along`, 4 u of d, is still a point of the segment, so the distance
  // is off by no more than that.
  if (asked == Asked::overlap && detail::verdict(out, std::sqrt(q.squaredNorm()) - (ra + rb), error)) return;
  V3<R> v = q;
  if (std::abs(along) < h) {
    v -= axis * axis.dot(v);
    // Where half of the length cancels, a second pass makes it orthogonal (Parlett 1980, 6-9: twice is
    // enough).
    if (v.squaredNorm() < R(0.25) * q.squaredNorm()) v -= axis * axis.dot(v);
  }
  const R dist = std::sqrt(v.squaredNorm());
  const V3<R> n = dist > 0 ? detail::direction<R>(v, dist) : V3<R>(axis.unitOrthogonal());
  const R shortfall = std::max<R>(0, dist - (n.dot(d) - std::abs(n.dot(axis)) * h));
  if (asked == Asked::overlap && detail::verdict(out, dist - (ra + rb), error + shortfall)) return;
  detail::inflate<R>(out, dist, n, V3<R>::Zero(), q, ra, rb, shortfall + error,
                     std::max(std::max(ra, rb + h), detail::largest(d) / 2));
}

namespace detail {

template <class R>
struct SegmentPair {
  V3<R> axis_a, axis_b, d;  // d: from A's centre to B's
  R ha, hb;
  /// Separation of the support planes along a unit n, A to B.
  R separation(const V3<R>& n) const {
    return n.dot(d) - std::abs(n.dot(axis_a)) * ha - std::abs(n.dot(axis_b)) * hb;
  }
};

template <class R>
struct SegmentFeet {
  R s = 0, t = 0, dist = std::numeric_limits<R>::infinity(), sine_sq = 0;
  bool level = false;  // the normal comes from try_level, not from the feet
  V3<R> normal;
};

// Takes the difference of the feet, orthogonal to every axis whose interior contains its foot.
template <class R>
void try_feet(const SegmentPair<R>& p, R s, R t, SegmentFeet<R>& best) {
  V3<R> v = p.d + t * p.axis_b - s * p.axis_a;
  if (std::abs(s) < p.ha) v -= p.axis_a * p.axis_a.dot(v);
  if (std::abs(t) < p.hb) v -= p.axis_b * p.axis_b.dot(v);
  const R dist = v.norm();
  if (!(dist < best.dist)) return;
  best.s = s;
  best.t = t;
  best.dist = dist;
  if (dist > 0) best.normal = direction<R>(v, dist);
}

// Tries a direction orthogonal to the segments, for feet that coincide within rounding: their own difference
// is noise. It is not necessarily the better one.
template <class R>
void try_level(const SegmentPair<R>& p, const V3<R>& n, SegmentFeet<R>& best) {
  const V3<R> m = n.dot(p.d) < 0 ? V3<R>(-n) : n;
  if (p.separation(m) > p.separation(best.normal)) {
    best.normal = m;
    best.level = true;
  }
}

// Parameters come from cross products: their error grows as 1/sin of the angle, that of the normal equations
// as 1/sin². Outside the segments, one foot is clamped, then the other (Ericson 2005, 5.1.9).
template <class R>
SegmentFeet<R> segment_feet(const SegmentPair<R>& p) {
  SegmentFeet<R> best;
  const V3<R> n = p.axis_a.cross(p.axis_b);
  const R nn = best.sine_sq = n.squaredNorm();
  R s = 0;
  if (nn > rounding::parallel_sine_sq * u<R> * u<R>) {
    const R inverse = 1 / nn, t = p.d.cross(p.axis_a).dot(n) * inverse;
    s = p.d.cross(p.axis_b).dot(n) * inverse;
    if (std::abs(s) <= p.ha && std::abs(t) <= p.hb) {
      const R along = p.d.dot(n), scale = std::sqrt(inverse);
      best.s = s;
      best.t = t;
      best.dist = std::abs(along) * scale;
      best.normal = n * std::copysign(scale, along);
      return best;
    }
    s = std::clamp(s, -p.ha, p.ha);
  }
  const R free_t = (s * p.axis_a - p.d).dot(p.axis_b), t = std::clamp(free_t, -p.hb, p.hb);
  if (t != free_t) s = std::clamp((p.d + t * p.axis_b).dot(p.axis_a), -p.ha, p.ha);
  best.normal = p.axis_a.unitOrthogonal();
  try_feet(p, s, t, best);
  return best;
}

// For feet that do not prove to be nearest (nearly parallel, or touching within rounding): tries all ends,
// and directions that do not depend on the feet.
template <class R>
void retry_feet(const SegmentPair<R>& p, SegmentFeet<R>& best) {
  for (const R s : {-p.ha, p.ha})
    try_feet(p, s, std::clamp((s * p.axis_a - p.d).dot(p.axis_b), -p.hb, p.hb), best);
  for (const R t : {-p.hb, p.hb})
    try_feet(p, std::clamp((p.d + t * p.axis_b).dot(p.axis_a), -p.ha, p.ha), t, best);
  const V3<R> n = p.axis_a.cross(p.axis_b);
  const R nn = n.squaredNorm();
  if (nn > rounding::parallel_sine_sq * u<R> * u<R>) try_level(p, V3<R>(n * (1 / std::sqrt(nn))), best);
  const V3<R> x = p.axis_a.unitOrthogonal(), y = p.axis_a.cross(x);
  try_level(p, x, best);
  try_level(p, y, best);
}

}  // namespace detail

/// Returns whether the segments are so nearly parallel that they may share an interval.
template <class R>
bool capsule_capsule(const Shape& sa, const Pose& pa, const Shape& sb, const Pose& pb, Asked asked,
                     Answer<R>& out) {
  const auto &ca = *std::get_if<Capsule>(&sa), &cb = *std::get_if<Capsule>(&sb);
  const RoundedPose<R> a = rounded_pose<R>(pa), b = rounded_pose<R>(pb);
  const detail::SegmentPair<R> p{axis_z(a), axis_z(b), b.t - a.t, static_cast<R>(ca.half_height),
                                 static_cast<R>(cb.half_height)};
  const R ra = static_cast<R>(ca.radius), rb = static_cast<R>(cb.radius);
  if (!detail::squares_hold(std::max(std::max(ra + p.ha, rb + p.hb), detail::largest(p.d)))) return false;
  const R rounding = u<R> * (8 * p.d.template lpNorm<1>() + 24 * (p.ha + p.hb) + 4 * (ra + rb));
  detail::SegmentFeet<R> f = detail::segment_feet(p);
  const auto shortfall = [&] { return std::max<R>(0, f.dist - p.separation(f.normal)); };
  R error = rounding + shortfall();
  if (error > 2 * rounding) {
    detail::retry_feet(p, f);
    error = rounding + shortfall();
  }
  const V3<R>& n = f.normal;
  if (asked == Asked::overlap && detail::verdict(out, f.dist - (ra + rb), error)) return false;
  V3<R> foot_a = f.s * p.axis_a, foot_b = p.d + f.t * p.axis_b;
  if (f.level) {
    const V3<R> middle = (foot_a + foot_b) / 2;
    foot_a = middle - f.dist / 2 * n;
    foot_b = middle + f.dist / 2 * n;
  }
  detail::inflate<R>(out, f.dist, n, foot_a, foot_b, ra, rb, error,
                     std::max(std::max(ra + p.ha, rb + p.hb), detail::largest(p.d) / 2));
  return f.sine_sq < R(tolerance::parallel_sine_sq);
}

}  // namespace touchstone::narrow::filtered
