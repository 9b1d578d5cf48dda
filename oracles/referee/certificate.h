// Builds certificates (referee.h) from the results of the levels.
#pragma once

#include "oracles/referee/filter/convex.h"

namespace touchstone::referee {

/// A strictly separating plane across `direction`; in doubles if one exists there, else in rationals. Kind
/// none when the direction does not separate with certainty.
Certificate plane_certificate(const Difference& d, const Real3& direction, const Vec3& origin);
Certificate point_certificate(const Real3& point, const Vec3& origin);
/// The point itself, in rationals, and rounded.
Certificate common_point_certificate(const Rational3& point);
Certificate exact_certificate(const ExactPair& p, const ExactVerdict& v);
/// `depth`: the proven lower bound of the depth, balls included; the certificate claims what remains after
/// its points are rounded.
Certificate inner_certificate(const InnerPolytope& p, const Vec3& origin, Real depth);
/// From one point of each core, balls not included.
Certificate core_pair_certificate(const Real3& a, const Real3& b, const Vec3& origin, Real depth);
/// Certifies that the two are at least -t.hi deep in each other; `t` must be an overlap found with
/// Effort::certificate.
Certificate lower_depth_certificate(const ConvexTruth& t, const Difference& d, const Vec3& origin);

}  // namespace touchstone::referee
