// A certificate of a broad phase as text that fits 80 columns, and as a page that a person reads.
#pragma once

#include <string>

#include "fuzz/record/broad_certificate.h"

namespace touchstone::reports {

/// `times`: with the seconds that each evidence took.
std::string certificate_text(const fuzz::BroadCertificate& c, bool times);

/// One HTML file that loads nothing and runs nothing.
std::string certificate_page(const fuzz::BroadCertificate& c);

/// "SUBJECT: boxes certified, bodies refuted".
std::string certificate_line(const fuzz::BroadCertificate& c);

}  // namespace touchstone::reports
