#pragma once

#include <string>

#include "reports/record/plan.h"

namespace touchstone::reports {

/// What to run and how much it saves, then the evidence; in 80 columns.
std::string plan_text(const fuzz::Plan& p);

}  // namespace touchstone::reports
