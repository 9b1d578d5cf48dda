// Fingerprints of engines, for people.
#pragma once

#include <string>

#include "reports/record/fingerprint.h"

namespace touchstone::reports {

/// One line a question, and one for all.
std::string fingerprint_text(const fuzz::Fingerprint& f);

/// Which answers differ: one line a question and pair of shapes.
std::string difference_text(const fuzz::Fingerprint& a, const fuzz::Fingerprint& b,
                            const fuzz::FingerprintDifference& d);

}  // namespace touchstone::reports
