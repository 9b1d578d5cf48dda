#pragma once

#include <string>

#include "reports/record/plan.h"

namespace touchstone::reports {

/// What to run and what it saves, then the evidence; 80 columns.
std::string plan_text(const fuzz::Plan& p);

}  // namespace touchstone::reports
