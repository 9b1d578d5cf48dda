#include "reports/chart/chart_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/record/result.h"

namespace touchstone::fuzz {
namespace {

bool has(const Judgement& j, std::initializer_list<Fault> faults) {
  return std::any_of(j.faults.begin(), j.faults.end(), [&](const FaultReport& r) {
    return std::find(faults.begin(), faults.end(), r.fault) != faults.end();
  });
}

void count(ChartRow& r, const Judgement& j) {
  ++r.asked;
  if (was_not_attempted(j.outcome)) return;
  if (j.outcome != Outcome::answered) {
    ++r.failed;
    return;
  }
  ++r.answers;
  r.missed += has(j, {Fault::missed});
  r.ghost += has(j, {Fault::ghost, Fault::stale});
  r.no_number += has(j, {Fault::no_number, Fault::normal_not_unit});
  r.wrong += !j.faults.empty();
  r.rounding += j.blame == Blame::representation;
  r.undecided += j.undecided;
  r.not_judged += j.ruling() == Ruling::not_judged && !j.unjudged_by_definition();
  r.wide_claim += j.wide_claim > 0;
  r.pairs_true += j.pairs_true;
  r.pairs_reported += j.pairs_reported;
}

// Candidates have no ghosts: every broad phase may report superfluous pairs, but none may lose a pair.
std::string why_unsound(const ChartRow& r) {
  const std::pair<std::uint64_t, const char*> kinds[] = {
      {r.missed, "missed"}, {r.ghost, "ghosts"}, {r.no_number, "no number"}, {r.failed, "failed"}};
  std::string why;
  for (const auto& [n, what] : kinds)
    if (n > 0) why += fmt::format("{}{} {}", why.empty() ? "" : ", ", n, what);
  const std::uint64_t named = r.missed + r.ghost + r.no_number;
  if (r.wrong > named)
    why +=
        why.empty() ? fmt::format("{} wrong", r.wrong) : fmt::format(", {} otherwise wrong", r.wrong - named);
  if (!why.empty()) return fmt::format("{} of {}", why, r.answers + r.failed);
  if (r.answers == 0) return "answers nothing";
  if (!is_timed(r)) return "its times include the pipe";
  if (r.not_judged > 0) return fmt::format("{} of {} not judged", r.not_judged, r.answers);
  // Being right within a very wide tolerance does not prove accuracy.
  if (r.wide_claim > 0)
    return fmt::format("claims a tolerance above 1e-2 L for {} of {}", r.wide_claim, r.answers);
  // An engine that skips the hard cases is not comparable.
  if (r.answers < r.asked) return fmt::format("answers {} of {}", r.answers, r.asked);
  return "";
}

double inaccuracy(const ChartRow& r) { return r.question == "candidates" ? 1 - r.precision() : r.error_p99; }

bool as_accurate(const ChartRow& a, const ChartRow& b) {
  return inaccuracy(a) <= inaccuracy(b) && a.error_max <= b.error_max;
}

enum class Standing { behind, tie, front };

// Times count as different only if they differ by more than the rounds did, and by more than half.
constexpr double least_noise = 0.5;

// The standing of b as judged against a alone. Errors depend only on the seed, but times vary between runs.
// With `least_noise`, a second run moves a row by at most one standing, and from front to behind only if
// noise exceeds a factor of 2.25. 2026-11-22, two quick charts on a machine with three times as many jobs as
// cores: of 16,789 sound rows none changed between front and behind and 1,057 changed to or from a tie; with
// a quarter instead of a half, 4 changed between front and behind, and with two standings instead of three,
// 634.
Standing standing(const ChartRow& a, const ChartRow& b) {
  if (!as_accurate(a, b)) return Standing::front;
  const double same = 1 + std::max({a.ns_spread, b.ns_spread, least_noise});
  if (b.ns_median * same < a.ns_median) return Standing::front;
  return b.ns_median > a.ns_median * same ? Standing::behind : Standing::tie;
}

}  // namespace

double quantile(std::vector<double>& values, double q) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

void ChartRows::add(const ChartSample& s) {
  const std::string none, crowd = s.bodies > 2 ? fmt::format("{:09}", s.bodies) : "";
  std::vector<std::array<std::string, 3>> groups{{s.regime, none, s.scale}, {s.regime, none, none}};
  if (s.bodies == 2)
    groups.insert(
        groups.end(),
        {{none, none, none}, {none, none, s.scale}, {none, s.pair, none}, {s.regime, s.pair, none}});
  // Rows by scale would be duplicates where there is only one.
  std::sort(groups.begin(), groups.end());
  const bool has_scales = s.question == "overlap" || s.question == "distance" || s.question == "contact";
  if (!has_scales) std::erase_if(groups, [](const auto& g) { return !g[2].empty(); });
  for (const auto& [regime, pair, scale] : groups) {
    Cell& c = cells_[{s.question, regime, scale, pair, crowd, s.engine}];
    ChartRow& r = c.counts;
    r.engine = s.engine;
    r.question = s.question;
    r.regime = regime;
    r.pair = pair;
    r.scale = scale;
    r.bodies = s.bodies;
    count(r, s.judgement);
    if (s.judgement.outcome != Outcome::answered) continue;
    if (!s.judgement.undecided) c.errors.push_back(s.judgement.worst_in_l);
    if (!s.ns.empty()) c.ns.push_back(s.ns);
  }
}

ChartRow ChartRows::finished(const Cell& c) const {
  ChartRow r = c.counts;
  std::vector<double> least, errors = c.errors, medians;
  for (const auto& ns : c.ns) least.push_back(*std::min_element(ns.begin(), ns.end()));
  for (std::size_t k = 0; !c.ns.empty() && k < c.ns[0].size(); ++k) {
    std::vector<double> round;
    for (const auto& ns : c.ns) round.push_back(ns[k]);
    medians.push_back(quantile(round, 0.5));
  }
  r.ns_min = quantile(least, 0);
  r.ns_median = quantile(least, 0.5);
  r.ns_p99 = quantile(least, tail_quantile);
  if (const double fastest = quantile(medians, 0); fastest > 0)
    r.ns_spread = (quantile(medians, 0.5) - fastest) / fastest;
  r.error_p50 = quantile(errors, 0.5);
  r.error_p99 = quantile(errors, tail_quantile);
  r.error_max = quantile(errors, 1);
  r.unsound = why_unsound(r);
  return r;
}

std::vector<ChartRow> ChartRows::rows() const {
  std::vector<ChartRow> all;
  for (const auto& [key, c] : cells_)
    if (c.counts.answers + c.counts.failed > 0) all.push_back(finished(c));
  mark_fronts(all);
  return all;
}

void mark_fronts(std::vector<ChartRow>& rows) {
  const auto same = [](const ChartRow& a, const ChartRow& b) {
    return a.question == b.question && a.regime == b.regime && a.pair == b.pair && a.scale == b.scale &&
           a.bodies == b.bodies;
  };
  // The rows of a group are adjacent.
  for (std::size_t first = 0, end = 0; first < rows.size(); first = end) {
    while (end < rows.size() && same(rows[first], rows[end])) ++end;
    for (std::size_t i = first; i < end; ++i) {
      if (!rows[i].unsound.empty()) continue;
      Standing place = Standing::front;
      for (std::size_t k = first; k < end; ++k)
        if (k != i && rows[k].unsound.empty()) place = std::min(place, standing(rows[k], rows[i]));
      rows[i].front = place != Standing::behind;
      rows[i].tie = place == Standing::tie;
    }
  }
}

}  // namespace touchstone::fuzz
