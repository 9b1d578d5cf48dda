// How big a case is, and every number in it. The shrinker only takes what is smaller by this measure, so that
// it ends.
#pragma once

#include "scenarios/random/numbers.h"
#include "scenarios/value/case.h"
#include "scenarios/value/case_size.h"

namespace touchstone::fuzz {

CaseSize measure(const Case& c);

/// Significant bits of the mantissa and bits of the exponent: 0 costs 0, 1 costs 1, 0.1 costs 56.
int bits_of(double v);

/// v rounded to `significant` bits, to nearest.
double rounded_to(double v, int significant);

}  // namespace touchstone::fuzz
