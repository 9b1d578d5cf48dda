#include "fuzz/triage/ledger.h"

#include <algorithm>
#include <tuple>

#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {
namespace {

std::string last_updated(const KnownFinding& f) { return std::max(f.last_seen, f.expired); }

}  // namespace

KnownFinding merged(const KnownFinding& x, const KnownFinding& y) {
  const auto first = [](const KnownFinding& f) { return std::tie(f.first_seen, f.first_build); };
  const auto last = [](const KnownFinding& f) { return std::tie(f.last_seen, f.last_build); };
  const auto size = [](const KnownFinding& f) { return std::tie(f.size, f.smallest, f.words); };
  // Ties go to the row that still reproduces.
  const auto updated = [](const KnownFinding& f) {
    return std::tuple(last_updated(f), f.expired.empty(), f.expired);
  };
  KnownFinding r = size(y) < size(x) ? y : x;
  std::tie(r.first_seen, r.first_build) = std::min(first(x), first(y));
  std::tie(r.last_seen, r.last_build) = std::max(last(x), last(y));
  r.expired = (updated(x) < updated(y) ? y : x).expired;
  r.count = std::max(x.count, y.count);
  return r;
}

std::size_t merge_ledgers(const std::filesystem::path& out, std::span<const std::filesystem::path> in) {
  for (const auto& file : in) require_regular_file(file);
  Ledger sum(out);
  for (const auto& file : in) {
    std::error_code ec;
    if (std::filesystem::equivalent(file, out, ec)) continue;
    for (const KnownFinding& f : Ledger(file, Ledger::For::reading).all()) {
      const auto known = sum.find(f.key);
      sum.put(known ? merged(*known, f) : f);
    }
  }
  sum.commit();
  return sum.all().size();
}

}  // namespace touchstone::fuzz
