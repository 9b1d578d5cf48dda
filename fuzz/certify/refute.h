// A wrong answer as the smallest script that shows it.
#pragma once

#include "fuzz/certify/certify.h"
#include "fuzz/certify/fault_cause.h"
#include "reports/record/broad_certificate.h"

namespace touchstone::fuzz {

/// `c` is the case of `found`. A subject whose answers depend on what it was asked before is asked anew each
/// time. What is kept while shrinking is the class of the fault: a solid pair stays solid.
Refutation refute(const Subject& subject, const EvidenceRow& e, const FaultCount& found, const Case& c);

/// Bodies that the script inserts; without one all.
std::size_t bodies_used(const Case& c);

}  // namespace touchstone::fuzz
