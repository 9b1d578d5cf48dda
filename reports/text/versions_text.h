// Which release of an engine has which cause, for people.
#pragma once

#include <string>

#include "reports/record/versions.h"

namespace touchstone::reports {

/// A block a cause, in 80 columns for up to six releases. Text from data is made printable.
std::string versions_text(const fuzz::VersionTable& t);

/// A heading and a table with one row a cause. Text from data is escaped.
std::string versions_markdown(const fuzz::VersionTable& t);

}  // namespace touchstone::reports
