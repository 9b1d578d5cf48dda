// First contact of two bodies that do not turn, in closed form or not at all.
//
// With constant rotations the separation along a fixed n is linear in t, so two of its values prove all
// between: a hit at t is stated when some n separates, beyond the error, at 0 and at t, and the gap at t is
// proven to be at most `accuracy`; a miss when n separates at 0 and at 1, or one does up to a time and
// another from there on. What fails these tests, grazing above all, is left to the search. Errors are those
// of core/narrow/filtered/query.h with one difference: the rounded matrix that takes world to body
// coordinates is the same for offset and velocity, so its own error acts on the offset at the time in
// question, which is short at contact:
//
//   u (8 r_A + 36 r_B + 16 |o(t)| + 5 |o(0)| + 6 t |v|).
#pragma once

#include "core/impact/filtered/impact_search.h"
#include "core/narrow/filtered/body.h"

namespace touchstone::ccd::fast {

/// A pair in translation; v is B's velocity as seen from A.
struct Translation {
  narrow::fast::Stand<double> a, b;
  Vec velocity;
};

/// Two boxes: the separating axis test over the whole step (Gottschalk 2000, §3.3, with the axes of
/// core/narrow/filtered/box_box.h). Nearest points are not worked out. `unsure`: ask the search.
Search translating_boxes(const Translation& m, const Vec& half_a, const Vec& half_b, double accuracy);

/// Ball A and box B: the ray of the centre against the rounded box, piece by piece of its surface.
Search translating_ball_and_box(const Translation& m, double radius, const Vec& half, double accuracy);

/// A sphere, half_height 0, or a capsule about its z axis.
struct Round {
  double half_height, radius;
};

/// Two of these: Newton's method on the distance of their axes.
Search translating_rounds(const Translation& m, const Round& a, const Round& b, double accuracy);

/// Hulls and boxes: a ray cast against their Minkowski difference, with the errors of sweep.h.
Search translating_polytopes(const Sweep& sweep, double accuracy);

}  // namespace touchstone::ccd::fast
