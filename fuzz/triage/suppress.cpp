#include <algorithm>

#include "core/base/input_error.h"
#include "fuzz/triage/triage.h"
#include "scenarios/text/iso_date.h"
#include "scenarios/text/name_list.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {
namespace {

KnownCause known_cause(const Ledger& ledger, const std::string& id) {
  if (auto known = ledger.find(id)) return *std::move(known);
  std::vector<std::string> ids;
  for (const KnownCause& k : ledger.all()) ids.push_back(k.id);
  throw InputError(printable(id), "the ledger has no such cause" + did_you_mean(id, ids));
}

bool is_blank(const std::string& text) { return text.find_first_not_of(" \t\n") == std::string::npos; }

}  // namespace

void suppress(Ledger& ledger, const std::string& id, const std::string& reason, const std::string& until,
              const std::string& today) {
  KnownCause k = known_cause(ledger, id);
  if (is_blank(reason)) throw InputError("--reason", "is empty");
  if (!is_iso_date(until))
    throw InputError("--until", "is not a date such as 2026-11-23: " + printable(until));
  if (until < today.substr(0, iso_date_length)) throw InputError("--until", until + " has passed");
  k.reason = printable(reason, "\n");
  k.until = until;
  ledger.put(k);
}

void unsuppress(Ledger& ledger, const std::string& id) {
  KnownCause k = known_cause(ledger, id);
  if (k.until.empty()) throw InputError(id, "is not suppressed");
  k.reason.clear();
  k.until.clear();
  ledger.put(k);
}

}  // namespace touchstone::fuzz
