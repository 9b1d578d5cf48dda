#include "reports/text/record_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

constexpr std::size_t most_lines = 20;  // of one list; JSON has them all

template <class List, class Line>
std::string listed(const char* title, const List& list, const Line& line) {
  if (list.empty()) return "";
  std::string s = fmt::format("  {} ({}):\n", title, grouped(list.size()));
  for (std::size_t i = 0; i < std::min(list.size(), most_lines); ++i) s += "    " + line(list[i]) + "\n";
  if (list.size() > most_lines) s += fmt::format("    and {} more\n", grouped(list.size() - most_lines));
  return s;
}

std::string finding_line(const fuzz::ResultChanges::OfFinding& f) {
  std::string what;
  const auto add = [&](bool differs, const std::string& word) {
    if (differs) what += (what.empty() ? "" : ", ") + word;
  };
  add(f.count_before != f.count_after, fmt::format("{} -> {} answers", f.count_before, f.count_after));
  add(f.first_case, "another first case");
  add(f.words, "another message");
  add(f.evidence && !f.first_case, "other evidence");
  return f.key + ": " + what;
}

}  // namespace

std::string changes_text(const fuzz::ResultChanges& c) {
  if (c.none) return "Judged again: the same as stored.\n";
  const auto key = [](const std::string& k) { return k; };
  return "Judged again: NOT the same as stored.\n" + listed("findings that appeared", c.appeared, key) +
         listed("findings that went", c.gone, key) +
         listed("findings that changed", c.changed, finding_line) +
         listed("counts that changed", c.counts, [](const fuzz::ResultChanges::OfCount& n) {
           return fmt::format("{} {}: {} {} -> {}", n.engine, n.subject, n.count, n.before, n.after);
         });
}

}  // namespace touchstone::reports
