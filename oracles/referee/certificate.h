// Certificates (referee.h) from what the levels found.
#pragma once

#include "oracles/referee/convex.h"

namespace touchstone::referee {

/// A plane along `direction` that strictly separates; in doubles if one exists there, else with rationals.
/// Kind none when the direction does not separate with certainty.
Certificate plane_certificate(const Difference& d, const Real3& direction, const Vec3& origin);
Certificate point_certificate(const Real3& point, const Vec3& origin);
Certificate exact_certificate(const ExactPair& p, const ExactVerdict& v);
Certificate inner_certificate(const InnerPolytope& p, const Vec3& origin);

}  // namespace touchstone::referee
