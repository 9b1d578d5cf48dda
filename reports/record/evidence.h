// The evidence for a finding: the case, the answer, and what its certificate is about.
#pragma once

#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

/// As values; fuzz/ask/evidence.h writes them as JSON, with a certificate that `touchstone check` verifies.
struct Evidence {
  Case c;
  Observation observation;
  ReceivedScene received;
  Certificate certificate;
  int a = -1, b = -1;  // bodies A and B of the certificate; a < 0: it is not about a pair
  int step = -1;       // >= 0: poses at that query of the script; < 0: the bodies' own
  Question question = Question::overlap;
};

}  // namespace touchstone::fuzz
