// One query in the arithmetic R (double or float): placed shapes as R holds them, the pose of B in A's frame,
// and an answer with its own error bound.
//
// Rounding is accounted for backwards: what is computed is exact, up to the last few operations, for bodies
// displaced by at most `displacement`. Gap, distance and depth change by no more than the bodies move, so
// that displacement bounds the error of a gap, and whether a verdict is certain. u is R's unit roundoff.
//
// * R(q): the nine sums of products to 11 u in the Frobenius norm, the common factor 1/|q|² to 5 u: 16 u.
// * R_ab from conj(q_a)·q_b: components to 4 u |q_a||q_b| each, 8 u as a vector, 16 u as an angle; its
//   matrix another 16 u; applied to a point 3 u, and 1 u for the body's own support point: 36 u of B's reach.
// * R_aᵀ(t_b − t_a): 1 u for the difference, 16 u for the matrix, 3 u for the product: 20 u.
// * What is left is A's support point, a difference and a dot product: 8 u of A's reach.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/wide.h"
#include "core/narrow/narrow_phase.h"
#include "core/tolerance.h"

namespace touchstone::narrow::fast {

template <class R>
inline constexpr R u = std::numeric_limits<R>::epsilon() / 2;

/// A pose as R holds it. The quaternion need not be unit; its square neither over- nor underflows.
template <class R>
struct Stand {
  V3<R> t;
  R x, y, z, w;
};

template <class R>
inline Stand<R> stand(const Pose& p) {
  const Quat& q = p.rotation;
  const double n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  const Quat s = n > 0x1p-40 && n < 0x1p40 ? q : normalized(q);
  return {p.translation.cast<R>(), static_cast<R>(s.x), static_cast<R>(s.y), static_cast<R>(s.z),
          static_cast<R>(s.w)};
}

template <class R>
M3<R> matrix(const Stand<R>& s) {
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

/// Third column of the same: the axis of a round body.
template <class R>
V3<R> axis_z(const Stand<R>& s) {
  const R xx = s.x * s.x, yy = s.y * s.y, zz = s.z * s.z, ww = s.w * s.w, k = 1 / (xx + yy + zz + ww);
  return {2 * (s.x * s.z + s.w * s.y) * k, 2 * (s.y * s.z - s.w * s.x) * k, (ww - xx - yy + zz) * k};
}

/// B in A's body frame.
template <class R>
struct Relative {
  M3<R> a_to_world, b_to_a;
  V3<R> offset;  // of B's origin
};

template <class R>
Relative<R> relative(const Stand<R>& a, const Stand<R>& b) {
  Relative<R> r;
  r.a_to_world = matrix(a);
  const Stand<R> q{
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
  touching,  // the gap is known as well as asked, its sign is not
  unsure     // the value is not known as well as asked, or the verdict alone was asked and is not certain
};

/// World axes, origin at A's translation. For Asked::overlap nothing but `found` is set when it is certain.
template <class R>
struct Answer {
  Found found = Found::unsure;
  bool valued = false;  // searches: gap, normal and points are set
  R gap = 0;
  V3<R> normal, a, b;  // set when a value was asked and is known
  /// |gap − truth|; for a depth also: its excess over the least depth, and what is missing along `normal`.
  R bound = std::numeric_limits<R>::infinity();
};

/// The displacement that the account above comes to; lengths are the cores' reaches and the offset.
template <class R>
R displacement_of(R reach_a, R reach_b, R offset) {
  return u<R> * (8 * reach_a + 36 * reach_b + 20 * offset);
}

/// τ for a scale no larger than L: what an answer's bound must meet.
template <class R>
R accuracy(R scale) {
  return R(tolerance::core_tau_factor) * u<R> * scale;
}

/// Whether an answer of that bound is given. Float has no one to ask: it answers up to 2τ and states the
/// bound, of which rounding of the input, that hardly ever adds up, is the larger part.
template <class R>
bool accepted(R bound, R scale) {
  return bound <= accuracy(scale) * (sizeof(R) == sizeof(float) ? 2 : 1);
}

template <class R>
Found decide(R gap, R error) {
  return gap > error ? Found::apart : (gap < -error ? Found::meeting : Found::touching);
}

}  // namespace touchstone::narrow::fast
