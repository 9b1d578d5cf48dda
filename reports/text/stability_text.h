// Ladders as text in 80 columns.
#pragma once

#include <string>

#include "reports/record/stability.h"

namespace touchstone::reports {

/// One table per question (engine × ladder) of the rung where each begins to fail; then a list of the
/// ladders.
std::string stability_text(const fuzz::Stability& s);

}  // namespace touchstone::reports
