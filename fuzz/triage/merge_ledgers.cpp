#include <algorithm>
#include <iterator>
#include <tuple>

#include "fuzz/triage/ledger.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {
namespace {

std::string last_updated(const KnownCause& k) { return std::max(k.last_seen, k.expired); }

std::vector<std::string> all_of_both(const std::vector<std::string>& x, const std::vector<std::string>& y) {
  std::vector<std::string> both;
  std::set_union(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(both));
  return both;
}

}  // namespace

// Every part is the greater or the smaller of two in a total order, or a union.
KnownCause merged(const KnownCause& x, const KnownCause& y) {
  const auto first = [](const KnownCause& k) { return std::tie(k.first_seen, k.first_build); };
  const auto last = [](const KnownCause& k) {
    return std::tie(k.last_seen, k.last_build, k.path, k.title, k.documented);
  };
  const auto shown = [](const KnownCause& k) {
    return std::tuple(k.shown.empty(), k.size, k.shown, k.engine, k.key, k.words);
  };
  const auto suppression = [](const KnownCause& k) { return std::tie(k.until, k.reason); };
  // Ties go to the row that is still shown.
  const auto updated = [](const KnownCause& k) {
    return std::tuple(last_updated(k), k.expired.empty(), k.expired);
  };
  KnownCause r = shown(y) < shown(x) ? y : x;
  std::tie(r.first_seen, r.first_build) = std::min(first(x), first(y));
  std::tie(r.last_seen, r.last_build, r.path, r.title, r.documented) = std::max(last(x), last(y));
  std::tie(r.until, r.reason) = std::max(suppression(x), suppression(y));
  r.expired = (updated(x) < updated(y) ? y : x).expired;
  r.severity = std::min(x.severity, y.severity);
  r.engines = all_of_both(x.engines, y.engines);
  r.shapes = all_of_both(x.shapes, y.shapes);
  r.count = std::max(x.count, y.count);
  return r;
}

std::size_t merge_ledgers(const std::filesystem::path& out, std::span<const std::filesystem::path> in) {
  for (const auto& file : in) require_regular_file(file);
  Ledger sum(out);
  for (const auto& file : in) {
    std::error_code ec;
    if (std::filesystem::equivalent(file, out, ec)) continue;
    for (const KnownCause& k : Ledger(file, Ledger::For::reading).all()) {
      const auto known = sum.find(k.id);
      sum.put(known ? merged(*known, k) : k);
    }
  }
  sum.commit();
  return sum.all().size();
}

}  // namespace touchstone::fuzz
