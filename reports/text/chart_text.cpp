#include "reports/text/record_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::ChartRow;
using Rows = std::vector<const ChartRow*>;

// Rows without times come last.
double shown_order(const ChartRow& r) { return is_timed(r) ? r.ns_median : HUGE_VAL; }
std::string time_text(const ChartRow& r, double ns) { return is_timed(r) ? nanoseconds(ns) : "pipe"; }

Rows by_time(const fuzz::Chart& c, const auto& keep) {
  Rows rows;
  for (const ChartRow& r : c.rows)
    if (r.answers > 0 && keep(r)) rows.push_back(&r);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto* a, const auto* b) { return shown_order(*a) < shown_order(*b); });
  return rows;
}

const char* mark(const ChartRow& r) { return r.tie ? "~" : r.front ? "*" : r.unsound.empty() ? " " : "o"; }

std::string percent(std::uint64_t n, std::uint64_t of) {
  if (n == 0) return "0";
  const double p = 100 * static_cast<double>(n) / static_cast<double>(std::max<std::uint64_t>(of, 1));
  constexpr double least_shown = 0.095;  // percent; below it "0.1" would overstate
  return p < least_shown ? "<0.1" : fmt::format("{:.1f}", p);
}

std::string question_table(const fuzz::Chart& c, const std::string& question) {
  const Rows rows = by_time(c, [&](const ChartRow& r) {
    return r.question == question && r.regime.empty() && r.pair.empty() && r.scale.empty();
  });
  if (rows.empty()) return "";
  std::string s = fmt::format("{}\n  {:<26}{:>6}{:>7}{:>8}{:>8}{:>8}{:>5}{:>5}{:>5}\n", question, "",
                              "ns p50", "ns p99", "err p50", "err p99", "err max", "mis%", "gho%", "fail");
  for (const ChartRow* r : rows)
    s += fmt::format("{} {:<26}{:>6}{:>7}{:>8}{:>8}{:>8}{:>5}{:>5}{:>5}\n", mark(*r), r->engine,
                     time_text(*r, r->ns_median), time_text(*r, r->ns_p99), small(r->error_p50),
                     small(r->error_p99), small(r->error_max), percent(r->missed, r->answers),
                     percent(r->ghost, r->answers), r->failed);
  return s;
}

std::string fronts(const fuzz::Chart& c, const std::string& question) {
  std::map<std::string, std::string> by_regime;
  for (const ChartRow* r : by_time(c, [&](const ChartRow& x) {
         return x.front && x.question == question && !x.regime.empty() && x.pair.empty() && x.scale.empty();
       }))
    by_regime[r->regime] += (by_regime[r->regime].empty() ? "" : ", ") + r->engine + (r->tie ? "~" : "");
  std::string s;
  for (const auto& [regime, engines] : by_regime)
    s += "  " + wrapped(fmt::format("front, {}: {}", regime, engines), 76, 4) + "\n";
  return s + "\n";
}

std::string crowds(const fuzz::Chart& c) {
  std::map<std::string, std::map<std::uint64_t, const ChartRow*>> engines;
  std::set<std::uint64_t> crowd_sizes;
  for (const ChartRow& r : c.rows)
    if (r.question == "candidates") {
      engines[r.engine][r.bodies] = &r;
      crowd_sizes.insert(r.bodies);
    }
  if (engines.empty()) return "";
  std::vector<std::pair<double, std::string>> lines;
  for (auto& [name, sizes] : engines) {
    std::string line = fmt::format("{} {:<26}", mark(*sizes.rbegin()->second), name);
    for (const std::uint64_t n : crowd_sizes)
      line +=
          fmt::format("{:>9}", !sizes.contains(n)          ? ""
                               : sizes.at(n)->answers == 0 ? "none"
                                                           : time_text(*sizes.at(n), sizes.at(n)->ns_median));
    std::erase_if(sizes, [](const auto& x) { return x.second->answers == 0; });
    if (sizes.empty()) {
      lines.emplace_back(HUGE_VAL, line);
      continue;
    }
    const ChartRow &first = *sizes.begin()->second, &last = *sizes.rbegin()->second;
    // Slope in the log-log plane between the smallest crowd and the largest.
    if (sizes.size() > 1 && is_timed(first) && is_timed(last))
      line += fmt::format("   n^{:.2f}",
                          std::log(last.ns_median / first.ns_median) /
                              std::log(static_cast<double>(last.bodies) / static_cast<double>(first.bodies)));
    line += fmt::format("{:>6.1f}%{}", 100 * last.precision(), last.missed ? " LOSES PAIRS" : "");
    lines.emplace_back(shown_order(last), line);
  }
  std::sort(lines.begin(), lines.end());
  std::string head = fmt::format("candidates, inserted and queried once, ns by bodies\n  {:<26}", "");
  for (const std::uint64_t n : crowd_sizes) head += fmt::format("{:>9}", n);
  head += "   growth  true\n";
  for (const auto& [t, line] : lines) head += line + "\n";
  return head + "\n";
}

std::string reasons(const fuzz::Chart& c) {
  std::map<std::string, std::string> why;
  for (const ChartRow& r : c.rows)
    if (!r.unsound.empty() && r.answers + r.failed > 0 && r.pair.empty() && r.scale.empty() &&
        (r.regime.empty() || r.question == "candidates")) {
      std::string what = r.question;
      if (r.question == "candidates") what += fmt::format(" of {}", r.bodies);
      why[r.engine] += fmt::format("{}{}: {}", why[r.engine].empty() ? "" : "; ", what, r.unsound);
    }
  std::string s = why.empty() ? "" : "Not on a front, with the reason (hollow on the page):\n";
  for (const auto& [engine, text] : why)
    s += "o " + wrapped(fmt::format("{}: {}", engine, text), 76, 4) + "\n";
  return s + "\n";
}

}  // namespace

std::string chart_text(const fuzz::Chart& c) {
  std::string s =
      "Errors are measured by the referee and divided by the scale L. * on the Pareto front (time p50, error "
      "p99), ~ on it but tied within noise, o wrong somewhere.\n";
  s = wrapped(s, 79, 0) + "\n";
  for (const char* q : {"overlap", "distance", "contact", "within", "bounded_distance", "contact_within",
                        "ray", "time_of_impact"})
    if (const std::string table = question_table(c, q); !table.empty()) s += table + fronts(c, q);
  s += crowds(c) + reasons(c);
  double spread = 0;
  for (const ChartRow& r : c.rows)
    if (r.regime.empty() && r.pair.empty() && r.scale.empty()) spread = std::max(spread, r.ns_spread);
  return s +
         wrapped(fmt::format("{}, {} cores, load {:.1f}, {}, {}; {} chart, seed {}, {} rounds; a typical "
                             "round is at most {:.0f} % slower than the fastest.",
                             c.machine.processor, c.machine.cores, c.machine.load, c.machine.system,
                             c.machine.date, c.scope, c.seed, c.rounds, 100 * spread),
                 79, 0) +
         "\n";
}

}  // namespace touchstone::reports
