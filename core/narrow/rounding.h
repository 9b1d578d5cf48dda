// What the searches of the narrow phase cannot tell from zero: factors of the unit roundoff u of the
// arithmetic, or of its ε = 2u, and, for a length, of the size of the pair: the reach of both bodies plus
// their separation. A factor that is too small makes a search stall or take noise for a direction
// (tests/core/narrow, tests/core "ladder of the gap"); one that is too large leaves pairs undecided that need
// not be.
#pragma once

namespace touchstone::narrow::rounding {

// ---- double and float, in u

/// A height above a support plane: a support point's coordinate along a unit direction is the end of about
/// four roundings. GJK calls a shorter distance touching; a polytope grows only by points that are farther
/// out.
inline constexpr int height = 4;
/// The same where feet, features and edges of both bodies enter, twice as many roundings.
inline constexpr int feature_height = 8;
/// A difference of such heights that is certainly not noise: slack of a curvature or of a distance to be
/// proven.
inline constexpr int certain_height = 64;
/// Height of a triangle, above its longest edge, below which its normal is noise: 16 times `height`.
inline constexpr int sliver_height = 64;
/// Distance within which corners of supporting faces coincide, or lie on an edge or in a plane; of lengths up
/// to the size, with a plane's tilt.
inline constexpr int corner_distance = 32;
/// The same where a capsule's axis is compared with a face or an edge of a box.
inline constexpr int axis_distance = 64;
/// The sum of the terms of a formula of a dozen operations, relative to it.
inline constexpr int formula = 64;
/// Sine of the angle between two axes, squared, in u²: their cross product has no correct digit below.
inline constexpr int parallel_sine_sq = 64;
/// Sine of the angle between two axes that are parallel as far as their rounded rotations can tell.
inline constexpr int parallel_sine = 16;
/// The sum of a gap and a radius, in units of the radius: two roundings of it, and two of the gap's.
inline constexpr int ball = 4;

// ---- any arithmetic, in ε

/// Twice the area of a triangle, in units of the product of two edges, below which its normal is noise. Only
/// extended precision tests it.
inline constexpr int flat_triangle = 16;
/// The volume of a tetrahedron, as a product of three lengths each of a few roundings.
inline constexpr int volume = 4;

// ---- extended precision, in ε

/// As `height` and `sliver_height`, with room for upright normals.
inline constexpr int wide_height = 8, wide_sliver_height = 128;
/// Differences of support values over a meridian that are noise (descend.h).
inline constexpr int wide_support_noise = 16;

}  // namespace touchstone::narrow::rounding
