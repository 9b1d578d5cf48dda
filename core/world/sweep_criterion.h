// Which bodies and pairs must be swept, and what stays unseen when the others are not.
//
// Setting: one step, constant velocities, contact is looked for at the end pose; the start pose was the end
// pose of the step before. A pass is a pair that overlaps at some t in (0,1) but at neither end.
//
// Claim. A pass that is not swept is nowhere deeper than pass_bound = |v_a − v_b|/2 + turn_a + turn_b, with
// turn = min(R·|ω|/2, R − r₀), where the body's support about its origin is between r₀ and R along every
// direction: between balls, or, with r₀ < 0, of a body that has a point −r₀ from its origin.
// Proof. Depth δ at t means that the difference set D(t) = B − A has support h_D(n) >= δ along every unit n,
// up to the offset of the bodies, that is, it holds the ball of radius δ about the origin (bodies convex; a
// mesh is taken triangle by triangle). From t to t' the support of a body along n changes by the travel of
// its origin along n and by what turning changes: at most R·|ω|·|t' − t|, since no point moves farther, and
// at most R − r₀, since both supports lie between r₀ and R. So h_D(n) loses at most f(|t' − t|) with f(s) =
// |v_a − v_b|·s + Σ min(R·|ω|·s, R − r₀). When δ > f(1 − t) the origin is still in D(1), the pair overlaps at
// the end; when δ > f(t) it overlaps at the start. A pass therefore has δ <= min(f(t), f(1 − t)) <= f(1/2), f
// being non-decreasing. ∎ (An end pose that is rounded to doubles adds its rounding to what stays unseen.)
//
// Inner extent. r is the radius of a ball inside the body, anywhere. D holds a ball of radius r_a + r_b,
// which is the depth of a pass through the middle: a ball through a plate is r_a + half the thickness deep. A
// pair is swept when
//     pass_bound > share · (r_a + r_b).
// So every pass that is left unseen is at most `share` times as deep as one through the middle: with 1/2, a
// corner may be clipped, nothing gets past the middle of anything.
// A half-space has no middle to get past, and only its normal matters: under translation the depth along it
// is linear in time, with slope s, hence greatest at an end, where it is seen. Turning may hide min((c − s)(1
// − t), (c + s)t) <= c/2 with c = R·|ω|, and no more than R − r₀: the turn bound, against r of the body
// alone.
//
// Bodies. |v_a − v_b| <= |v_a| + |v_b|, so when neither body exceeds share · r by |v|/2 + turn of its own,
// their pair does not either. A body that does is flagged; pairs without a flagged body need no look.
#pragma once

#include "core/shape/shape.h"

namespace touchstone {

struct InnerExtent {
  double inner = 0;         // r: radius of a ball inside the shape, rounded down; 0: flat, or a mesh
  double about_origin = 0;  // r₀; < 0 when the body may not hold its origin
  double reach = 0;         // R; infinite for a half-space
};

/// Once a shape. A hull's ball is about the mean of its vertices: not the largest, but inside.
InnerExtent inner_extent(const Shape& shape);

/// min(R·|ω|/2, R − r₀).
double turn_bound(const InnerExtent& e, const Motion& m);

/// Of the body against things at rest: |v|/2 + turn.
double pass_bound(const InnerExtent& e, const Motion& m);

/// Of the pair, as claimed above; of a half-space, against it.
double pass_bound(const InnerExtent& a, const Motion& ma, const InnerExtent& b, const Motion& mb);

/// Flagged: what the body does exceeds share · r.
bool is_flagged(const InnerExtent& e, const Motion& m, double share);

bool needs_sweep(const InnerExtent& a, const Motion& ma, const InnerExtent& b, const Motion& mb,
                 double share);

}  // namespace touchstone
