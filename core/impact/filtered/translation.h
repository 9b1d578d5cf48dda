// First contact of two bodies that do not rotate, in closed form or not at all.
//
// With constant rotations the separation along a fixed n is linear in t, so two of its values prove
// everything in between. A hit at t is reported if some n separates, beyond the error, at 0 and at t, and the
// gap at t is proven to be at most `accuracy`; a miss if n separates at 0 and at 1, or if one n separates up
// to a time and another from there on. Cases that fail these tests, above all grazing ones, are left to the
// search. Errors are those of core/narrow/filtered/query.h with one difference: the rounded matrix that takes
// world to body coordinates is the same for offset and velocity, so its own error acts on the offset at the
// time in question, which is short at contact:
//
//   u (8 r_A + 36 r_B + 16 |o(t)| + 5 |o(0)| + 6 t |v|).
#pragma once

#include "core/impact/filtered/impact_search.h"
#include "core/narrow/filtered/query.h"

namespace touchstone::impact::filtered {

/// A pair in translation; `velocity` is that of B relative to A.
struct Translation {
  narrow::filtered::RoundedPose<double> a, b;
  Vec velocity;
};

/// In units of the error: beyond `certain_errors` a separation is proven, with margin for its own rounding; a
/// hit aims at `aimed_errors`.
inline constexpr double certain_errors = 1.25, aimed_errors = 1.75;

/// Two boxes: the separating axis test over the whole step (Gottschalk 2000, §3.3, with the axes of
/// core/narrow/filtered/box_box.h). Nearest points are not computed. `unsure`: use the search.
Search translating_boxes(const Translation& m, const Vec& half_a, const Vec& half_b, double accuracy);

/// Ball A and box B: the ray of the centre against the rounded box, one piece of its surface at a time.
Search translating_ball_and_box(const Translation& m, double radius, const Vec& half, double accuracy);

/// A sphere, half_height 0, or a capsule about its z axis.
struct Round {
  double half_height, radius;
};

/// Two rounds: Newton's method on the distance of their axes.
Search translating_rounds(const Translation& m, const Round& a, const Round& b, double accuracy);

/// Hulls and boxes: a ray cast against their Minkowski difference, with the errors of sweep.h.
Search translating_polytopes(const Sweep& sweep, double accuracy);

}  // namespace touchstone::impact::filtered
