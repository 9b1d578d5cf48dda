// Sign of a determinant of long doubles, exactly.
#pragma once

#include "oracles/referee/filter/real3.h"

namespace touchstone::referee {

/// Sign of det(a, b, c).
int determinant_sign(const Real3& a, const Real3& b, const Real3& c);
/// Sign of det(b - a, c - a, p - a): > 0 when p is in front of the triangle, seen from the side on which a,
/// b, c are counter-clockwise.
int orientation_sign(const Real3& a, const Real3& b, const Real3& c, const Real3& p);

}  // namespace touchstone::referee
