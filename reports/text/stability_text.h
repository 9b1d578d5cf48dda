// Ladders as text in 80 columns.
#pragma once

#include <string>

#include "reports/record/stability.h"

namespace touchstone::reports {

/// A table a question: engine × ladder, the rung where each begins to fail; then what the ladders are.
std::string stability_text(const fuzz::Stability& s);

}  // namespace touchstone::reports
