// A broad-phase certificate as text in 80 columns.
#pragma once

#include <string>

#include "reports/record/broad_certificate.h"

namespace touchstone::reports {

/// `times`: with the seconds that each suite took.
std::string certificate_text(const fuzz::BroadCertificate& c, bool times);

/// "SUBJECT: boxes certified, bodies refuted", followed by the suites that were too slow and the time they
/// need.
std::string certificate_line(const fuzz::BroadCertificate& c);

}  // namespace touchstone::reports
