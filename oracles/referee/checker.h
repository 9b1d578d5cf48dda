// Checks a verdict's certificate in rationals, from the scene alone. Shares nothing with what found the
// certificate but the value of a double and of a placed point.
#pragma once

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// True when the certificate proves its verdict for these two bodies: a separating plane (closed sets: A on
/// direction·x <= offset, B on direction·x > offset) or a common point. Spheres, boxes, capsules, hulls,
/// half-spaces; false for anything that it cannot check.
bool check(const Certificate& c, const Placed& a, const Placed& b);

}  // namespace touchstone::referee
