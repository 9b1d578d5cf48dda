// One case in full as text: the scene, the referee's answer with its certificate, and every engine's answer
// with its blame.
#pragma once

#include <string>

#include "reports/record/judged_case.h"

namespace touchstone::reports {

/// At most 80 columns.
std::string replay_text(const fuzz::JudgedCase& judged);

}  // namespace touchstone::reports
