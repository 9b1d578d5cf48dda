// What shows a finding: the case, the answer, and a certificate that `touchstone check` verifies.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "fuzz/judge/judgement.h"
#include "fuzz/record/observation_json.h"

namespace touchstone::fuzz {

/// The certificates of one case made so far, by (motion?, A, B, step): engines that fail alike on a case
/// share them. Of one thread at a time.
using CaseCertificates = std::map<std::tuple<bool, int, int, int>, Json>;

/// Kept as values and written as JSON only when somebody asks.
struct Evidence {
  Case c;
  Observation observation;
  ReceivedScene received;
  referee::Certificate certificate;
  int a = -1, b = -1;  // bodies A and B of the certificate; a < 0: it names none
  int step = -1;       // >= 0: where the script has them at that query, not at their own poses
  Question question = Question::overlap;
  std::shared_ptr<CaseCertificates> shared;  // may be empty
  /// {"case", "observation", "certificate", "received"}, made once; of one thread at a time. The certificate
  /// is the one that the checker accepts, if there is one, and names its "bodies" [A, B] and "step".
  const Json& json() const;
  mutable Json made = {};
};

/// The body at its own pose (step < 0), or where the script has it at that query; nothing when it is not
/// there.
std::optional<referee::Placed> placed_at(const Scene& s, int body, int step);

/// The referee's certificate of the verdict on two bodies (time_of_impact: of the first contact) as the
/// checker accepts it, naming its "bodies" and "step"; null when there is no such form.
Json exact_certificate(const Scene& s, Question q, int a, int b, int step = -1);

}  // namespace touchstone::fuzz
