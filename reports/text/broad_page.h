// The textbook picture of a broad phase, as one self-contained HTML page: boxes in a projection, their
// intervals on each axis, the cells, tree or order of a method, the pairs kept and pruned, and a slider over
// the queries.
#pragma once

#include <string>

#include "reports/record/broad_view.h"

namespace touchstone::reports {

/// Boxes are rounded to 1e-5 of the picture's size; counts and pairs are those of the unrounded boxes.
std::string broad_page(const fuzz::BroadView& view);

}  // namespace touchstone::reports
