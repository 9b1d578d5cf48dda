// A certificate of a broad phase as text that fits 80 columns.
#pragma once

#include <string>

#include "reports/record/broad_certificate.h"

namespace touchstone::reports {

/// `times`: with the seconds that each evidence took.
std::string certificate_text(const fuzz::BroadCertificate& c, bool times);

/// "SUBJECT: boxes certified, bodies refuted"; with what was too slow, and the time to ask for.
std::string certificate_line(const fuzz::BroadCertificate& c);

}  // namespace touchstone::reports
