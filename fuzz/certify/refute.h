// A wrong answer as the smallest script that shows it.
#pragma once

#include "fuzz/certify/candidate_verdict.h"
#include "fuzz/certify/certify.h"

namespace touchstone::fuzz {

/// `found`: what was wrong with the case when the evidence was gathered. A subject whose answers depend on
/// what it was asked before is asked anew each time.
Refutation refute(const Subject& subject, const EvidenceRow& e, std::uint64_t index, const Case& c,
                  const CandidateVerdict& found);

/// Bodies that the script inserts.
std::size_t bodies_used(const Scene& s);

}  // namespace touchstone::fuzz
