// What a triage found, for people and for continuous integration.
#pragma once

#include <string>
#include <vector>

#include "reports/record/observation_json.h"
#include "reports/record/triage.h"

namespace touchstone::reports {

/// New, back and gone findings by name; the others as counts. 80 columns but for keys.
std::string triage_text(const std::vector<fuzz::Triaged>& triaged);
fuzz::Json triage_json(const std::vector<fuzz::Triaged>& triaged);
/// JUnit: a suite an engine, a test case a finding; new and back ones fail, known ones are skipped, gone ones
/// pass.
std::string triage_junit(const std::vector<fuzz::Triaged>& triaged);

}  // namespace touchstone::reports
