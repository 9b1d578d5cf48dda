// Finds the certificates that prove a finding.
#pragma once

#include <optional>

#include "reports/record/evidence.h"

namespace touchstone::fuzz {

/// Implements Evidence::write.
Json evidence_to_json(const Evidence& e);

/// The body at its own pose (step < 0), or at its pose in that query of the script; nullopt when it is not
/// there.
std::optional<Placed> placed_at(const Scene& s, int body, int step);

/// The referee's certificate of the verdict on two bodies (for time_of_impact: of the first contact) in a
/// form that the checker accepts, with its "bodies" and "step"; null when there is no such form.
Json exact_certificate(const Scene& s, Question q, int a, int b, int step = -1);

}  // namespace touchstone::fuzz
