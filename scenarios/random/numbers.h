// Every number of a case, to be changed in place.
#pragma once

#include <vector>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// Every double of the case that a person would have to write down, in a fixed order: fields of shapes, then
/// poses and motions of bodies, then poses of steps. What is derived from them (faces of hulls) is stale
/// after a change until renew().
std::vector<double*> numbers(Case& c);
std::vector<double*> numbers(Shape& s);
/// Throws InputError when a vertex is not finite.
void renew(Case& c);

}  // namespace touchstone::fuzz
