// The picture that broad phases are taught with, as one page of HTML that loads nothing: boxes in a
// projection, their intervals on each axis, the cells, tree or order of a method, the pairs kept and pruned;
// a slider over the queries.
#pragma once

#include <string>

#include "reports/record/broad_view.h"

namespace touchstone::reports {

/// Boxes are rounded to a 1e-5th of the picture; counts and pairs are those of the boxes as they were.
std::string broad_page(const fuzz::BroadView& view);

}  // namespace touchstone::reports
