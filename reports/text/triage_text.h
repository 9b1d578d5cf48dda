// The result of a triage, for people and for continuous integration.
#pragma once

#include <string>
#include <vector>

#include "reports/record/observation_json.h"
#include "reports/record/triage.h"

namespace touchstone::reports {

/// Lists new, back, flaky and gone findings and counts the others. 80 columns, except for keys.
std::string triage_text(const std::vector<fuzz::Triaged>& triaged);
fuzz::Json triage_json(const std::vector<fuzz::Triaged>& triaged);
/// JUnit: one suite per engine and one test case per finding. New and back findings fail, known ones are
/// skipped, gone ones pass.
std::string triage_junit(const std::vector<fuzz::Triaged>& triaged);

}  // namespace touchstone::reports
