// Access to every number of a case, for changes in place.
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

}  // namespace touchstone::fuzz
