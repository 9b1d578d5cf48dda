// The referee's own constants: where it stops, and how far it searches. None of them decides what is true: a
// bracket abandoned early is wider, never wrong.
#pragma once

namespace touchstone::referee::limits {

/// Brackets of curved pairs are refined until they are this narrow, in units of the pair's extent (>= L/4 or
/// so); the specification asks for 1e-14·L. Below 1e-17 extended precision has nothing left to give. Tested
/// by: tests/referee "brackets are narrow".
inline constexpr double width_factor = 4e-16;

/// Facets that the inner polytope of a polytope pair / of a curved pair may use before the referee returns
/// the wider bracket that it has (counts, no scale). Two 256-vertex hulls in general position need under
/// 3000; a curved pair with one nearest point about 400. Tested by: tests/referee "brackets are narrow".
inline constexpr int facet_cap = 40000;
inline constexpr int curved_facet_cap = 3000;
/// The same when symmetry has already closed the bracket and only witness points are needed (1e-4 of the
/// size).
inline constexpr int witness_facet_cap = 160;

/// Gap evaluations that one judge_motion may spend (a count). A thin wall with |ω| = 500 needs about 5000.
/// Tested by: tests/referee "thin walls are never passed through".
inline constexpr int motion_evaluations = 20000;

/// Distances from a rounded witness, in units of the pair's size, within which the referee searches for a
/// common point with simple coordinates: from the rounding of a double to the square root of its bracket's
/// width (the contact point of a smooth contact is known no better). A guess is proven or dropped, so the
/// factors cost time but never affect truth. Tested by: tests/referee "exact contact of curved bodies on a
/// lattice".
inline constexpr double guess_factors[] = {0x1p-50, 0x1p-44, 0x1p-36, 0x1p-28, 0x1p-22, 0x1p-16};

/// 1/φ, the share of an interval that a step of a golden-section search keeps.
inline constexpr double golden = 0.6180339887498949;

}  // namespace touchstone::referee::limits
