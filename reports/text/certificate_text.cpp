#include "reports/text/record_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::BroadCertificate;
using fuzz::EvidenceCount;
using fuzz::LevelVerdict;

// Superfluous pairs per true pair, in 7 columns; "-" if no pair is true.
std::string price(std::uint64_t reported, std::uint64_t truth) {
  if (truth == 0) return "-";
  const double more = reported > truth ? static_cast<double>(reported - truth) : 0;
  const double ratio = more / static_cast<double>(truth);
  constexpr double least_shown = 0.001;  // smaller ratios need more columns
  if (ratio > 0 && ratio < least_shown) return "<0.001";
  return ratio < 1000 ? fmt::format("{:.3g}", ratio) : fmt::format("{:.1e}", ratio);
}

// Seconds that fit into 5 columns after rounding to a tenth.
constexpr double most_with_tenths = 99.95;

// Columns are separated by a space even if an entry is too wide.
std::string in_columns(std::string_view kind, std::string_view name, const std::string& cases,
                       const std::string& queries, const std::string& pairs, const std::string& price,
                       const std::string& seconds) {
  return fmt::format("  {:<11} {:<19} {:>9} {:>9} {:>11} {:>7}{}{}\n", kind, name, cases, queries, pairs,
                     price, seconds.empty() ? "" : " ", seconds);
}

std::string row(const EvidenceCount& e, bool times) {
  return in_columns(to_string(e.kind), e.name, grouped(e.cases), grouped(e.queries), grouped(e.pairs_true),
                    price(e.pairs_reported, e.pairs_true),
                    times ? fmt::format("{:>5.{}f}", e.seconds, e.seconds < most_with_tenths ? 1 : 0) : "");
}

std::string table(const BroadCertificate& c, BroadLevel level, bool times) {
  std::string out =
      in_columns("kind", "suite", "cases", "queries", "true pairs", "price", times ? "    s" : "");
  for (const EvidenceCount& e : c.evidence) {
    if (e.level != level) continue;
    out += row(e, times);
    if (e.refused > 0)
      out += "      " + wrapped(fmt::format("{} of them refused: {}", grouped(e.refused), e.refusal), 72, 6) +
             "\n";
  }
  return out;
}

// If N random cases show no miss, the miss rate is below 3/N with 95 % confidence (the rule of three).
std::string random_bound(const BroadCertificate& c, BroadLevel level) {
  std::string out;
  for (const EvidenceCount& e : c.evidence)
    if (e.level == level && e.kind == SuiteKind::random && e.answered > 0)
      out += fmt::format("  {}: miss rate below {:.2g} per scene (95 % confidence)\n", e.name,
                         3.0 / static_cast<double>(e.answered));
  return out;
}

std::string cases_of(std::uint64_t n) { return counted(n, "case", "cases"); }

// A class of fault: its smallest script, then the suites in which it was seen.
std::string refutation(const BroadCertificate& c, const fuzz::Refutation& r) {
  std::string out =
      "  " +
      wrapped(fmt::format("{} ({}, case {}): {}", in_words(r.what), r.evidence, r.index, r.words), 76, 4);
  if (r.steps > 0)
    out += fmt::format("\n    smallest script: {}, {} ({})\n", counted(r.bodies, "body", "bodies"),
                       counted(r.steps, "step", "steps"), r.shrink);
  else
    out += fmt::format("\n    smallest scene: {} ({})\n", counted(r.bodies, "body", "bodies"), r.shrink);
  std::string seen;
  for (const fuzz::FaultCount& f : c.faults)
    if (f.level == r.level && f.what == r.what)
      seen += fmt::format(
          "{}{} ({}{})", seen.empty() ? "" : ", ", f.evidence, cases_of(f.cases),
          f.what.kind == fuzz::FaultKind::solid ? fmt::format(", by up to {:.2g} of the size", f.share) : "");
  return out + "    " + wrapped("seen in " + seen, 76, 4) + "\n";
}

std::string slow(const fuzz::TooSlow& t) {
  const std::string enough = t.sufficient > 0 ? fmt::format("it answers within {:g}: use --case-seconds {:g}",
                                                            t.sufficient, t.sufficient)
                             : t.tried > t.allowed ? fmt::format("nor within {:g}", t.tried)
                                                   : std::string("raise --case-seconds");
  return "  " +
         wrapped(fmt::format(
                     "too slow for {}: no answer within {:g} CPU s per question in case {}, {} bodies, {} "
                     "steps; {}",
                     t.evidence, t.allowed, t.index, t.bodies, grouped(t.steps), enough),
                 76, 4) +
         "\n";
}

std::string level_text(const BroadCertificate& c, BroadLevel level, bool times) {
  const char* what = level == BroadLevel::boxes ? "every overlapping pair of the given boxes"
                                                : "every truly overlapping pair of bodies";
  std::string out =
      fmt::format("\nLevel of {}: {} ({})\n", to_string(level), to_string(verdict(c, level)), what);
  out += table(c, level, times);
  if (verdict(c, level) == LevelVerdict::certified) out += random_bound(c, level);
  for (const auto& r : c.refutations)
    if (r.level == level) out += refutation(c, r);
  for (const auto& t : c.too_slow)
    if (t.level == level) out += slow(t);
  return out;
}

// The slowest suite decides how much time is needed.
std::string too_slow_words(const BroadCertificate& c) {
  if (c.too_slow.empty()) return "";
  std::string names;
  double allowed = 0, enough = 0;
  bool known = true;
  for (const auto& t : c.too_slow) {
    names += (names.empty() ? "" : ", ") + t.evidence;
    allowed = t.allowed;
    enough = std::max(enough, t.sufficient);
    known = known && t.sufficient > 0;
  }
  const std::string more = known ? fmt::format(" to {:g}", enough) : "";
  return fmt::format("; too slow for {} ({:g} CPU s per question); raise --case-seconds{}", names, allowed,
                     more);
}

}  // namespace

std::string certificate_line(const BroadCertificate& c) {
  std::string out = c.subject + ":";
  for (const BroadLevel l : c.levels)
    out += fmt::format("{} {} {}", l == c.levels.front() ? "" : ",", to_string(l), to_string(verdict(c, l)));
  return out + too_slow_words(c);
}

std::string certificate_text(const BroadCertificate& c, bool times) {
  std::string out = fmt::format("{}: {} {}, scope {}, seed {}{}\n", c.subject, c.card.library, c.card.version,
                                c.scope, c.seed, c.limit ? fmt::format(", limit {}", c.limit) : "");
  if (c.margin)
    out += fmt::format("margin {:g}: every pair no farther apart must be a candidate\n", *c.margin);
  if (!c.plugin_hash.empty()) out += fmt::format("plug-in {}\n", c.plugin_hash);
  for (const BroadLevel l : c.levels) out += level_text(c, l, times);
  out += "\nprice: superfluous pairs per true pair. Not proved:\n";
  for (const std::string& line : not_proved(c)) out += "- " + wrapped(line, 76, 2) + "\n";
  return out + fmt::format("digest {:016x}\n", digest(c));
}

}  // namespace touchstone::reports
