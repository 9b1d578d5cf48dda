// Checks a stored certificate from the scene alone, in rationals and rational bounds of square roots. Shares
// the scene's value types with the rest of the project, but no code with what finds certificates. The other
// parts are checker_set.h (exact sets) and checker_motion.cpp (sets in motion).
#pragma once

#include "core/math/pose.h"
#include "scenarios/value/certificate.h"

namespace touchstone::checker {

/// Support points in a certificate are doubles. The checker allows each to be this · (its largest coordinate)
/// outside the core and subtracts the same amount from the proven depth, so the factor never affects truth: 8
/// roundings of a coordinate, where a rounded point is off by at most √3/2. Tested by: tests/referee
/// "an inner polytope is refused when a point, a facet or the depth is changed".
inline constexpr double point_factor = 0x1p-50;

/// What a certificate of each kind proves when it holds:
///   separating_plane  A on direction·x <= offset, B on direction·x > offset. With rationals: any number of
///                     planes, four numbers each; each pair of triangles of meshes needs one of them.
///                     A solid mesh is its triangles here; besides, neither body may be inside the other.
///   common_point      the point is in both bodies.
///   depth_direction   B moved by `offset` along direction/|direction| shares no interior point with A.
///   inner_polytope    depth >= offset: the facets' surface encloses the origin of A-B at that distance.
///                     Without facets: one pair of core points near enough for the balls around them, or one
///                     point that is deep enough in a half-space.
/// False when it does not hold for these two bodies or is of a kind that proves nothing by itself. Throws
/// InputError for a malformed rational.
bool check(const Certificate& c, const Placed& a, const Placed& b);

/// Whether everything that the certificate claims holds for these bodies, in exact arithmetic
/// (checker_motion.cpp). False when it claims nothing. Throws InputError for a malformed rational.
bool check(const ImpactCertificate& c, const Placed& a, const Motion& motion_a, const Placed& b,
           const Motion& motion_b);

}  // namespace touchstone::checker
