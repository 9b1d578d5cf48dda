// The size of a case and of every number in it: how much there is to read for a person.
#pragma once

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

CaseSize measure(const Case& c);

/// Significant bits of the mantissa plus bits of the exponent: 0 costs 0, 1 costs 1, 0.1 costs 56.
int bits_of(double v);

}  // namespace touchstone::fuzz
