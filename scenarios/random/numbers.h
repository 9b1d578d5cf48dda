// Access to every number of a case, for changes in place, and the size of a case and of every number in it:
// how much there is to read for a person.
#pragma once

#include <vector>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// Every independent double of the case, in a fixed order: fields of shapes, then poses and motions of
/// bodies, then poses of steps, then the margin if it is not 0. Derived data (faces of hulls) is stale after
/// a change until renew().
std::vector<double*> numbers(Case& c);
std::vector<double*> numbers(Shape& s);
/// The sizes of the shape that may be zero (Domain::non_negative).
std::vector<double*> sizes_of(Shape& s);
/// Throws InputError when a vertex is not finite.
void renew(Case& c);

CaseSize measure(const Case& c);

/// Significant bits of the mantissa plus bits of the exponent: 0 costs 0, 1 costs 1, 0.1 costs 56.
int bits_of(double v);

}  // namespace touchstone::fuzz
