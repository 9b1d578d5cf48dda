// What changed when a stored campaign was judged again, as text.
#pragma once

#include <string>

#include "reports/record/changes.h"

namespace touchstone::reports {

/// At most 80 columns, except for the keys of findings; long lists are cut.
std::string changes_text(const fuzz::ResultChanges& c);

}  // namespace touchstone::reports
