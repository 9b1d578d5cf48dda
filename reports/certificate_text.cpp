#include "reports/certificate_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/text.h"

namespace touchstone::reports {
namespace {

using fuzz::BroadCertificate;
using fuzz::EvidenceCount;
using fuzz::Level;
using fuzz::LevelVerdict;

// Superfluous pairs per true pair; nothing where no pair is true.
std::string price(std::uint64_t reported, std::uint64_t truth) {
  if (truth == 0) return "-";
  const double more = reported > truth ? static_cast<double>(reported - truth) : 0;
  return fmt::format("{:.3g}", more / static_cast<double>(truth));
}

std::string row(const EvidenceCount& e, bool times) {
  return fmt::format("  {:<12}{:<20}{:>10}{:>11}{:>12}{:>7}{}\n", to_string(e.kind), e.name, grouped(e.cases),
                     grouped(e.queries), grouped(e.pairs_true), price(e.pairs_reported, e.pairs_true),
                     times ? fmt::format("{:>5.1f}", e.seconds) : "");
}

std::string table(const BroadCertificate& c, Level level, bool times) {
  std::string out = fmt::format("  {:<12}{:<20}{:>10}{:>11}{:>12}{:>7}{}\n", "kind", "evidence", "cases",
                                "queries", "true pairs", "price", times ? "    s" : "");
  for (const EvidenceCount& e : c.evidence) {
    if (e.level != level) continue;
    out += row(e, times);
    if (e.refused > 0)
      out += "      " + wrapped(fmt::format("{} of them refused: {}", grouped(e.refused), e.refusal), 72, 6) +
             "\n";
  }
  return out;
}

// Of a draw without a miss, the rate is below 3/N at 95 % (the rule of three).
std::string random_bound(const BroadCertificate& c, Level level) {
  std::string out;
  for (const EvidenceCount& e : c.evidence)
    if (e.level == level && e.kind == fuzz::EvidenceKind::random && e.answered > 0)
      out += fmt::format("  {}: fewer than {:.2g} of such scenes lose a pair (95 %)\n", e.name,
                         3.0 / static_cast<double>(e.answered));
  return out;
}

std::string refutation(const fuzz::Refutation& r) {
  std::string out =
      "  " + wrapped(fmt::format("{} in {}, case {}: {}", r.fault, r.evidence, r.index, r.words), 76, 2);
  out += fmt::format("\n  smallest script: {} bodies, {} steps ({})\n", r.bodies, r.steps, r.shrink);
  return out;
}

std::string level_text(const BroadCertificate& c, Level level, bool times) {
  const char* what = level == Level::boxes ? "every pair of the boxes given that overlap"
                                           : "every pair of bodies that truly overlap";
  std::string out =
      fmt::format("\nLevel of {}: {} ({})\n", to_string(level), to_string(verdict(c, level)), what);
  out += table(c, level, times);
  if (verdict(c, level) == LevelVerdict::certified) out += random_bound(c, level);
  for (const auto& r : c.refutations)
    if (r.level == level) out += refutation(r);
  return out;
}

}  // namespace

std::string certificate_line(const BroadCertificate& c) {
  std::string out = c.subject + ":";
  for (const Level l : c.levels)
    out += fmt::format("{} {} {}", l == c.levels.front() ? "" : ",", to_string(l), to_string(verdict(c, l)));
  return out;
}

std::string certificate_text(const BroadCertificate& c, bool times) {
  std::string out = fmt::format("{}: {} {}, scope {}, seed {}{}\n", c.subject, c.card.library, c.card.version,
                                c.scope, c.seed, c.limit ? fmt::format(", limit {}", c.limit) : "");
  if (!c.plugin_hash.empty()) out += fmt::format("plug-in {}\n", c.plugin_hash);
  for (const Level l : c.levels) out += level_text(c, l, times);
  out += "\nprice: superfluous pairs per true pair. Not proved:\n";
  for (const std::string& line : not_proved(c)) out += "- " + wrapped(line, 76, 2) + "\n";
  return out + fmt::format("digest {:016x}\n", digest(c));
}

}  // namespace touchstone::reports
