#include "reports/record/triage.h"

#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {

Json case_json_of(const KnownFinding& f) { return parse_json(f.smallest, "ledger, " + f.key); }

}  // namespace touchstone::fuzz
