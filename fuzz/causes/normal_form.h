// The plainest pair that shows a fault: reduced cases of one fault still differ by chance, and then respond
// differently (Groce, Holmes and Kellar 2017, "One test to rule them all", on normalizing test cases).
#pragma once

#include "fuzz/shrink/shrink.h"

namespace touchstone::fuzz {

/// The case with its two bodies as unit spheres, as cubes or as one of each, side by side and upright, with
/// the gap rounded to a power of two of their size; if none of these shows the fault, the case with single
/// bodies made plain where they can be. Where the fault needs what is plain no longer, the case itself.
Case normal_form(const Case& c, const StillShows& still);

}  // namespace touchstone::fuzz
