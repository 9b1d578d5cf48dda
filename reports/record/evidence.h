// The evidence for a finding: the case, the answer, and a certificate that `touchstone check` verifies.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "reports/record/observation_json.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

/// The certificates computed so far for one case, by (motion?, A, B, step). Engines that fail in the same way
/// on a case share them. Not thread-safe.
using CaseCertificates = std::map<std::tuple<bool, int, int, int>, Json>;

/// Kept as values; the JSON form is built only on demand.
struct Evidence {
  Case c;
  Observation observation;
  ReceivedScene received;
  Certificate certificate;
  int a = -1, b = -1;  // bodies A and B of the certificate; a < 0: it is not about a pair
  int step = -1;       // >= 0: poses at that query of the script; < 0: the bodies' own
  Question question = Question::overlap;
  std::shared_ptr<CaseCertificates> shared;  // may be empty
  /// Builds the JSON and, if needed, computes the certificate (fuzz/ask/evidence.h).
  Json (*write)(const Evidence&) = nullptr;
  /// {"case", "observation", "certificate", "received"}, built once. Not thread-safe. The certificate is one
  /// that the checker accepts, if there is one, and names its "bodies" [A, B] and "step".
  const Json& json() const;
  mutable Json made = {};
};

}  // namespace touchstone::fuzz
