#include "reports/record/triage.h"

#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {

Json case_json_of(const KnownCause& k) {
  return k.shown.empty() ? Json() : parse_json(k.shown, "ledger, " + k.id);
}

}  // namespace touchstone::fuzz
