// Reduces a wrong answer to the smallest script that shows it.
#pragma once

#include "fuzz/certify/certify.h"
#include "fuzz/certify/fault_cause.h"
#include "reports/record/broad_certificate.h"

namespace touchstone::fuzz {

/// `c` is the case of `found`. If the subject's answers depend on earlier questions, every case gets a new
/// engine. Shrinking keeps the class of the fault: a solid pair stays solid.
Refutation refute(const Subject& subject, const EvidenceRow& e, const FaultCount& found, const Case& c);

/// Number of bodies that the script inserts; all bodies if there is no script.
std::size_t bodies_used(const Case& c);

}  // namespace touchstone::fuzz
