// Which bodies and pairs must be swept, and what is missed when the others are not.
//
// Setting: one step with constant velocities. Contacts are computed at the end pose; the start pose is the
// end pose of the step before. A pass is a pair that overlaps at some t in (0,1) but at neither end.
//
// Claim. A pass that is not swept is nowhere deeper than pass_bound = |v_a − v_b|/2 + turn_a + turn_b, with
// turn = min(R·|ω|/2, R − r₀), where the body's support about its origin lies between r₀ and R along every
// direction: the body lies between two balls or, with r₀ < 0, has a point at distance −r₀ from its origin.
// Proof. Depth δ at t means that the difference set D(t) = B − A has support h_D(n) >= δ along every unit n,
// up to the offset of the bodies; that is, it contains the ball of radius δ about the origin (for convex
// bodies; a mesh is treated triangle by triangle). From t to t' the support of a body along n changes by the
// travel of its origin along n and by the effect of turning: at most R·|ω|·|t' − t|, since no point moves
// farther, and at most R − r₀, since both supports lie between r₀ and R. So h_D(n) decreases by at most f(|t'
// − t|) with f(s) = |v_a − v_b|·s + Σ min(R·|ω|·s, R − r₀). When δ > f(1 − t) the origin is still in D(1) and
// the pair overlaps at the end; when δ > f(t) it overlaps at the start. A pass therefore has δ <= min(f(t),
// f(1 − t)) <= f(1/2), because f is non-decreasing. ∎ (The rounding of an end pose to doubles adds to what
// may be missed.)
//
// Inner extent. r is the radius of a ball anywhere inside the body. D contains a ball of radius r_a + r_b,
// which is the depth of a pass through the middle: a ball that passes through a plate is r_a + half the
// thickness deep. A pair is swept when
//     pass_bound > share · (r_a + r_b).
// So every missed pass is at most `share` times as deep as one through the middle: with 1/2, a corner may be
// clipped, but nothing passes through the middle of anything.
// A half-space has no middle, and only its normal matters: under translation the depth along it is linear in
// time, with slope s, hence greatest at an end, where it is detected. Turning may hide min((c − s)(1 − t), (c
// + s)t) <= c/2 with c = R·|ω|, and no more than R − r₀: the turn bound, compared with r of the body alone.
//
// Bodies. |v_a − v_b| <= |v_a| + |v_b|, so when |v|/2 + turn exceeds share · r for neither body, the pair
// bound does not exceed it either. A body that exceeds it is flagged; pairs without a flagged body need no
// check.
#pragma once

#include "core/shape/shape.h"

namespace touchstone {

struct InnerExtent {
  double inner = 0;         // r: radius of a ball inside the shape, rounded down; 0: flat, or a mesh
  double about_origin = 0;  // r₀; < 0 when the body may not contain its origin
  double reach = 0;         // R; infinite for a half-space
};

/// Compute once per shape. The ball of a hull is centred at the mean of its vertices: not the largest, but
/// inside.
InnerExtent inner_extent(const Shape& shape);

/// min(R·|ω|/2, R − r₀).
double turn_bound(const InnerExtent& e, const Motion& m);

/// For the body against bodies at rest: |v|/2 + turn.
double pass_bound(const InnerExtent& e, const Motion& m);

/// For the pair, as claimed above; when one of them is a half-space, against it.
double pass_bound(const InnerExtent& a, const Motion& ma, const InnerExtent& b, const Motion& mb);

/// True when the body's pass bound exceeds share · r.
bool is_flagged(const InnerExtent& e, const Motion& m, double share);

bool needs_sweep(const InnerExtent& a, const Motion& ma, const InnerExtent& b, const Motion& mb,
                 double share);

}  // namespace touchstone
