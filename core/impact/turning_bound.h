// How far a pair of cores may advance along one direction n, fixed in the world or rotating with a constant
// Ω, when its separation is known at both ends.
//
// Every pair of core points has a separation n·(o + p_B − p_A), o the offset of the origins, p within the
// reach r of its core's origin and rotating with ω. Its second derivative is at most
//
//   K = Σ r |δ| (|Ω| + |ω|) + |Ω|² max|o| + 2 |Ω| |v|,   δ = ω − Ω, v the rate of o,
//
// because n·p changes at the rate n·(δ×p), and that rate at (Ω×n)·(δ×p) + n·(δ×(ω×p)). Where Ω = 0, the
// acceleration ω×(ω×p) is perpendicular to ω and K = Σ ρ |ω| |n×ω|, ρ the distance of p from the axis.
//
// So each separation, and hence their minimum s, lies on an interval of length h above the chord of its ends
// less K x (h − x)/2. From s1 and s2 at the ends, both beyond e, the minimum is beyond e if
//
//   K h²/2 <= (√(s1 − e) + √(s2 − e))².
#pragma once

#include "core/math/wide.h"

namespace touchstone::impact {

/// The part of K due to the offset, of length at most `far`, that changes at the rate `speed`; turn: |Ω|.
template <class R>
R offset_curvature(R turn, R far, R speed) {
  return turn * (turn * far + 2 * speed);
}

/// The part of K due to a core; relative: |δ|, spin: |ω|.
template <class R>
R core_curvature(R reach, R relative, R turn, R spin) {
  return reach * relative * (turn + spin);
}

/// The same where Ω = 0; reach: a bound on ρ, across: |n×ω|.
template <class R>
R core_curvature_along_fixed(R reach, R spin, R across) {
  return reach * spin * across;
}

/// Whether the separation stays beyond e over a step h; excess_1, excess_2: s1 − e and s2 − e, not negative.
/// `share`, slightly less than 1, covers the rounding of this bound.
template <class R>
bool stays_apart(R curvature, R h, R excess_1, R excess_2, R share = 1) {
  using std::sqrt;
  const R room = sqrt(excess_1) + sqrt(excess_2);
  return curvature * h * h / 2 <= room * room * share;
}

}  // namespace touchstone::impact
