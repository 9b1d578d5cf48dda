// The picture that broad phases are taught with, as one page of HTML that loads nothing: boxes in a
// projection, their intervals on each axis, the cells, tree or order of a method, the pairs kept and pruned;
// a slider over the queries.
#pragma once

#include <string>

#include "fuzz/record/broad_view.h"

namespace touchstone::reports {

std::string broad_page(const fuzz::BroadView& view);

}  // namespace touchstone::reports
