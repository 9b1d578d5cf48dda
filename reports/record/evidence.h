// What shows a finding: the case, the answer, and a certificate that `touchstone check` verifies.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "reports/record/observation_json.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

/// The certificates of one case made so far, by (motion?, A, B, step): engines that fail alike on a case
/// share them. Of one thread at a time.
using CaseCertificates = std::map<std::tuple<bool, int, int, int>, Json>;

/// Kept as values and written as JSON only when somebody asks.
struct Evidence {
  Case c;
  Observation observation;
  ReceivedScene received;
  Certificate certificate;
  int a = -1, b = -1;  // bodies A and B of the certificate; a < 0: it names none
  int step = -1;       // >= 0: where the script has them at that query, not at their own poses
  Question question = Question::overlap;
  std::shared_ptr<CaseCertificates> shared;  // may be empty
  /// How its JSON is made: a certificate is found when it is asked for (fuzz/ask/evidence.h).
  Json (*write)(const Evidence&) = nullptr;
  /// {"case", "observation", "certificate", "received"}, made once; of one thread at a time. The certificate
  /// is the one that the checker accepts, if there is one, and names its "bodies" [A, B] and "step".
  const Json& json() const;
  mutable Json made = {};
};

}  // namespace touchstone::fuzz
