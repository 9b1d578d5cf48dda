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

std::string escaped(const std::string& s) {
  std::string out;
  for (const char c : s) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

constexpr const char* head = R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Certificate</title>
<style>
:root{--ink:#1c2733;--soft:#66727f;--line:#d9dee4}
*{box-sizing:border-box}
body{margin:0 auto;padding:24px;max-width:1000px;font:15px/1.5 system-ui,"DejaVu Sans",sans-serif;color:var(--ink);background:#fff}
h1{font-size:22px;margin:0 0 4px}h2{font-size:16px;margin:26px 0 6px}
p{margin:4px 0;max-width:80ch}.soft{color:var(--soft)}
table{border-collapse:collapse;width:100%;margin:8px 0}
th{font-weight:600;text-align:left;border-bottom:1px solid var(--ink);padding:4px 8px 4px 0}
td{padding:4px 8px 4px 0;border-bottom:1px solid var(--line);vertical-align:top}
.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.certified{color:#1d6b3a;font-weight:600}.refuted{color:#b3261e;font-weight:600}
dl{display:grid;grid-template-columns:max-content 1fr;gap:2px 16px;margin:10px 0}dt{color:var(--soft)}dd{margin:0}
pre{background:#f5f7f9;border:1px solid var(--line);padding:10px;overflow:auto;font-size:13px}
</style></head><body>
)html";

std::string page_facts(const BroadCertificate& c) {
  std::string out = "<dl>";
  const auto fact = [&](const char* name, const std::string& value) {
    if (!value.empty()) out += fmt::format("<dt>{}</dt><dd>{}</dd>", name, escaped(value));
  };
  fact("Subject", c.subject);
  fact("Library", c.card.library + " " + c.card.version);
  fact("Settings", c.card.settings);
  fact("Hash of the plug-in", c.plugin_hash);
  fact("Arithmetic", c.card.unit_roundoff > 0x1p-50 ? "float" : "double");
  fact("Scope and seed", fmt::format("{}, seed {}{}", c.scope, c.seed,
                                     c.limit ? fmt::format(", at most {} cases an evidence", c.limit) : ""));
  fact("Made by", c.program);
  fact("Digest", fmt::format("{:016x}", digest(c)));
  return out + "</dl>\n";
}

std::string page_table(const BroadCertificate& c, Level level) {
  std::string out =
      "<table><tr><th>Evidence<th>What was tried<th class=n>Cases<th class=n>Refused<th class=n>Steps"
      "<th class=n>Queries<th class=n>True pairs<th class=n>Price</tr>\n";
  for (const EvidenceCount& e : c.evidence)
    if (e.level == level)
      out += fmt::format(
          "<tr><td>{}<br><span class=soft>{}</span><td>{}<td class=n>{}<td class=n>{}<td class=n>{}<td "
          "class=n>{}<td class=n>{}<td class=n>{}</tr>\n",
          e.name, to_string(e.kind), escaped(e.line), grouped(e.cases), grouped(e.refused), grouped(e.steps),
          grouped(e.queries), grouped(e.pairs_true), price(e.pairs_reported, e.pairs_true));
  return out + "</table>\n";
}

std::string page_level(const BroadCertificate& c, Level level) {
  const auto v = to_string(verdict(c, level));
  std::string out =
      fmt::format("<h2>Level of {}: <span class=\"{}\">{}</span></h2>\n", to_string(level), v, v);
  out +=
      level == Level::boxes
          ? "<p class=soft>Candidates must contain every pair of the boxes given that overlap, touching "
            "included. "
            "The boxes are exact in the subject's arithmetic.</p>\n"
          : "<p class=soft>Candidates must contain every pair of bodies that truly overlap, decided in exact "
            "arithmetic, whatever boxes the subject makes.</p>\n";
  out += page_table(c, level);
  for (const auto& r : c.refutations)
    if (r.level == level)
      out += fmt::format("<p>{}</p>\n<pre>{}</pre>\n", escaped(fmt::format("{}: {}", r.fault, r.words)),
                         escaped(refutation(r)));
  const std::string bound = verdict(c, level) == LevelVerdict::certified ? random_bound(c, level) : "";
  if (!bound.empty()) out += fmt::format("<pre>{}</pre>\n", escaped(bound));
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

std::string certificate_page(const BroadCertificate& c) {
  std::string out = head;
  out += fmt::format("<h1>{}</h1>\n<p>Is this broad phase conservative: does it ever lose a pair?</p>\n",
                     escaped(certificate_line(c)));
  out += page_facts(c);
  for (const Level l : c.levels) out += page_level(c, l);
  out += "<h2>What this does not prove</h2>\n<ul>\n";
  for (const std::string& line : not_proved(c)) out += "<li>" + escaped(line) + "\n";
  return out +
         "</ul>\n<p class=soft>Price: superfluous pairs per true pair. The certificate can be made again "
         "from "
         "itself alone: touchstone certify --check FILE.</p>\n</body></html>\n";
}

}  // namespace touchstone::reports
