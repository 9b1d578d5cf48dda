// The size of a case and of every number in it. The shrinker accepts only cases that are smaller by this
// measure, so it terminates.
#pragma once

#include "scenarios/random/numbers.h"
#include "scenarios/value/case.h"
#include "scenarios/value/case_size.h"

namespace touchstone::fuzz {

CaseSize measure(const Case& c);

/// Significant bits of the mantissa plus bits of the exponent: 0 costs 0, 1 costs 1, 0.1 costs 56.
int bits_of(double v);

/// Rounds v to the nearest number with `significant` bits.
double rounded_to(double v, int significant);

}  // namespace touchstone::fuzz
