// Sign of a determinant of long doubles, exactly.
#pragma once

#include "oracles/referee/real3.h"

namespace touchstone::referee {

/// Sign of det(a, b, c).
int determinant_sign(const Real3& a, const Real3& b, const Real3& c);

}  // namespace touchstone::referee
