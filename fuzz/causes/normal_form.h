// The plainest pair that shows a fault: reduced cases of one fault still differ by chance, and then respond
// differently (Groce, Holmes and Kellar 2017, "One test to rule them all", on normalizing test cases).
#pragma once

#include "fuzz/shrink/shrink.h"

namespace touchstone::fuzz {

/// The first of the plain cases (plain_cases.h) that shows the fault; if none does, the case with single
/// bodies and motions made plain where they can be. A case with more than two bodies or a script is returned
/// unchanged.
enum class PlainForms { nearest, all };
/// With `nearest`, only pairs at rest with about the gap of the case: responses of a fault then still vary as
/// its cases do, by which causes of engines with routes are told apart.
Case normal_form(const Case& c, const StillShows& still, PlainForms forms = PlainForms::all);

}  // namespace touchstone::fuzz
