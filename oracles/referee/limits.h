// The referee's own constants: where it stops, and how far it looks. None decides what is true: a bracket
// that is given up early is wider, never wrong.
#pragma once

namespace touchstone::referee::limits {

/// The referee refines a bracket of a curved pair until it is this narrow, in units of the pair's extent (>=
/// L/4 or so); issue: 1e-14·L. Below 1e-17 extended precision has nothing left to give. Bites: tests/referee,
/// width of brackets.
inline constexpr double width_factor = 4e-16;

/// Facets that the referee's inner polytope of a polytope pair / of a curved pair may use up before it
/// returns the wider bracket that it has (counts, no scale). Two 256-vertex hulls in general position need
/// under 3000; a curved pair with one nearest point about 400. Bites: tests/referee width of brackets.
inline constexpr int facet_cap = 40000;
inline constexpr int curved_facet_cap = 3000;
/// The same when symmetry has already closed the bracket and only witness points are wanted (1e-4 of the
/// size).
inline constexpr int witness_facet_cap = 160;

/// Gap evaluations that one judge_motion may spend (a count). A thin wall with |ω| = 500 needs
/// about 5000. Bites: tests/referee, motion.
inline constexpr int motion_evaluations = 20000;

/// How far from a rounded witness, in units of the pair's size, the referee looks for a common point with
/// simple coordinates: from the rounding of a double to the square root of its bracket's width (a smooth
/// contact's point is known no better). A guess is proven or dropped, so the factors cost time, never truth.
/// Bites: tests/referee, touching on a lattice.
inline constexpr double guess_factors[] = {0x1p-50, 0x1p-44, 0x1p-36, 0x1p-28, 0x1p-22, 0x1p-16};

}  // namespace touchstone::referee::limits
