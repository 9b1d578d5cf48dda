// The chart as text in 80 columns.
#pragma once

#include <string>

#include "reports/record/chart.h"

namespace touchstone::reports {

/// One table per question over all regimes, then the Pareto front of each regime, crowds, and the machine.
std::string chart_text(const fuzz::Chart& c);

}  // namespace touchstone::reports
