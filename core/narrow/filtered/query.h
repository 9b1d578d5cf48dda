// One query in the arithmetic R (double or float): placed shapes as represented in R, the pose of B in A's
// frame, and an answer with its own error bound.
//
// Rounding is accounted for by backward analysis: up to the last few operations, the computed result is exact
// for bodies displaced by at most `displacement`. Gap, distance and depth change by no more than the bodies
// move, so the displacement bounds the error of a gap and decides whether a verdict is certain. u is the unit
// roundoff of R.
//
// * R(q): the nine sums of products to 11 u in the Frobenius norm, the common factor 1/|q|² to 5 u: 16 u.
// * R_ab from conj(q_a)·q_b: components to 4 u |q_a||q_b| each, 8 u as a vector, 16 u as an angle; its matrix
//   another 16 u; applied to a point 3 u, and 1 u for the body's own support point: 36 u of B's reach.
// * R_aᵀ(t_b − t_a): 1 u for the difference, 16 u for the matrix, 3 u for the product: 20 u.
// * The rest is A's support point, a difference and a dot product: 8 u of A's reach.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/wide.h"
#include "core/narrow/narrow_phase.h"
#include "core/narrow/rounding.h"
#include "core/tolerance.h"

namespace touchstone::narrow::filtered {

template <class R>
inline constexpr R u = std::numeric_limits<R>::epsilon() / 2;

/// A pose as represented in R. The quaternion need not be unit; its square neither overflows nor underflows.
template <class R>
struct RoundedPose {
  V3<R> t;
  R x, y, z, w;
};

/// A quaternion whose squared norm is outside this range is normalised first: even in float its square is
/// then in range.
inline constexpr double least_quat_norm_sq = 0x1p-40, largest_quat_norm_sq = 0x1p40;

template <class R>
inline RoundedPose<R> rounded_pose(const Pose& p) {
  const Quat& q = p.rotation;
  const double n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  const Quat s = n > least_quat_norm_sq && n < largest_quat_norm_sq ? q : normalized(q);
  return {p.translation.cast<R>(), static_cast<R>(s.x), static_cast<R>(s.y), static_cast<R>(s.z),
          static_cast<R>(s.w)};
}

template <class R>
M3<R> matrix(const RoundedPose<R>& s) {
  const R xx = s.x * s.x, yy = s.y * s.y, zz = s.z * s.z, ww = s.w * s.w;
  const R k = 1 / (xx + yy + zz + ww);
  const R xy = s.x * s.y, xz = s.x * s.z, yz = s.y * s.z, wx = s.w * s.x, wy = s.w * s.y, wz = s.w * s.z;
  M3<R> r;
  r(0, 0) = (ww + xx - yy - zz) * k;
  r(0, 1) = 2 * (xy - wz) * k;
  r(0, 2) = 2 * (xz + wy) * k;
  r(1, 0) = 2 * (xy + wz) * k;
  r(1, 1) = (ww - xx + yy - zz) * k;
  r(1, 2) = 2 * (yz - wx) * k;
  r(2, 0) = 2 * (xz - wy) * k;
  r(2, 1) = 2 * (yz + wx) * k;
  r(2, 2) = (ww - xx - yy + zz) * k;
  return r;
}

/// Third column of that matrix: the axis of a round body.
template <class R>
V3<R> axis_z(const RoundedPose<R>& s) {
  const R xx = s.x * s.x, yy = s.y * s.y, zz = s.z * s.z, ww = s.w * s.w, k = 1 / (xx + yy + zz + ww);
  return {2 * (s.x * s.z + s.w * s.y) * k, 2 * (s.y * s.z - s.w * s.x) * k, (ww - xx - yy + zz) * k};
}

/// B's pose in A's body frame.
template <class R>
struct Relative {
  M3<R> a_to_world, b_to_a;
  V3<R> offset;  // of B's origin
};

template <class R>
Relative<R> relative(const RoundedPose<R>& a, const RoundedPose<R>& b) {
  Relative<R> r;
  r.a_to_world = matrix(a);
  const RoundedPose<R> q{
      V3<R>(), a.w * b.x - a.x * b.w - a.y * b.z + a.z * b.y, a.w * b.y + a.x * b.z - a.y * b.w - a.z * b.x,
      a.w * b.z - a.x * b.y + a.y * b.x - a.z * b.w, a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z};
  r.b_to_a = matrix(q);
  const V3<R> d = b.t - a.t;
  for (int k = 0; k < 3; ++k)
    r.offset[k] = r.a_to_world(0, k) * d[0] + r.a_to_world(1, k) * d[1] + r.a_to_world(2, k) * d[2];
  return r;
}

enum class Asked { overlap, distance, contact };

enum class Found {
  apart,     // gap > 0, certain
  meeting,   // gap < 0, certain
  touching,  // the gap is known to the required accuracy, its sign is not
  unsure     // the value is not accurate enough, or only the verdict was requested and is uncertain
};

/// World axes, origin at A's translation. For Asked::overlap only `found` is set when it is certain.
template <class R>
struct Answer {
  Found found = Found::unsure;
  bool valued = false;  // searches: gap, normal and points are set
  R gap = 0;
  V3<R> normal, a, b;  // set when a value was requested and is known
  /// |gap − truth|; for a depth, also its excess over the least depth and its shortfall along `normal`.
  R bound = std::numeric_limits<R>::infinity();
};

/// The displacement that results from the analysis above; the lengths are the cores' reaches and the offset.
template <class R>
R displacement_of(R reach_a, R reach_b, R offset) {
  return u<R> * (8 * reach_a + 36 * reach_b + 20 * offset);
}

/// Less than 1/(2√3): two bodies at a distance d have a coordinate of at least this · d.
template <class R>
inline constexpr R offset_share = R(0.28);

/// τ for a scale of at most L: the limit on an answer's bound.
template <class R>
R accuracy(R scale) {
  return R(tolerance::core_tau_factor) * u<R> * scale;
}

/// Whether an answer with this bound is accepted. Float has no fallback: it answers up to 2τ and reports the
/// bound, most of which is rounding of the input that rarely accumulates.
template <class R>
bool accepted(R bound, R scale) {
  return bound <= accuracy(scale) * (sizeof(R) == sizeof(float) ? 2 : 1);
}

template <class R>
Found decide(R gap, R error) {
  return gap > error ? Found::apart : (gap < -error ? Found::meeting : Found::touching);
}

}  // namespace touchstone::narrow::filtered
