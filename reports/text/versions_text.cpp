#include "reports/text/record_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/text/cause_words.h"
#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::Lifetime;
using fuzz::ReleaseSays;
using fuzz::VersionTable;

constexpr std::size_t line_width = 79, margin = 4;

constexpr std::string_view marks[] = {"X", "~", ".", "?", "-"};  // by Showing
constexpr std::string_view legend =
    "X shows it   ~ wrong in another way   . right   ? undecided   - cannot be asked";

std::string_view mark_of(const ReleaseSays& s) { return marks[static_cast<std::size_t>(s.showing)]; }

std::string introduced(const VersionTable& t, const Lifetime& life) {
  if (!life.first) return "in none of these";
  const std::string& first = t.releases[*life.first].number;
  return life.not_yet ? first : fmt::format("{} or before", first);
}

std::string gone(const VersionTable& t, const Lifetime& life) {
  std::string words = life.gone ? t.releases[*life.gone].number : "";
  if (life.comes_and_goes) words += fmt::format("{}comes and goes", words.empty() ? "" : "; ");
  return words;
}

std::string life_in_words(const VersionTable& t, const Lifetime& life) {
  std::string words = "introduced in " + introduced(t, life);
  if (!life.first) return "shown by none of these";
  if (life.not_yet) words += fmt::format(" (right in {})", t.releases[*life.not_yet].number);
  if (life.gone) words += fmt::format(", gone since {}", t.releases[*life.gone].number);
  return life.comes_and_goes ? words + ", comes and goes" : words;
}

template <class Cell>
std::string cells_of(const VersionTable& t, const Cell& cell) {
  std::string line(margin, ' ');
  for (std::size_t i = 0; i < t.releases.size(); ++i)
    line += fmt::format("{:<{}}", cell(i), std::max<std::size_t>(7, t.releases[i].number.size() + 1));
  return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

std::string paragraph(const std::string& words, std::size_t indent) {
  return wrapped(std::string(indent, ' ') + words, line_width, indent) + "\n";
}

std::string easy_questions(const VersionTable::Release& r) {
  return r.cannot.empty() ? fmt::format("{}/{}", r.answered - r.wrong, r.answered) : "-";
}

// The reasons why releases cannot be asked, each once.
std::string reasons(const VersionTable& t) {
  std::string text;
  for (const VersionTable::Release& r : t.releases)
    if (!r.cannot.empty()) text += paragraph(fmt::format("{}: {}", r.number, one_line(r.cannot)), margin);
  return text;
}

}  // namespace

std::string versions_text(const VersionTable& t) {
  std::string text =
      fmt::format("{} ({}): {} in {}\n{}\n\n", t.engine, t.package, counted(t.rows.size(), "cause", "causes"),
                  counted(t.releases.size(), "release", "releases"), legend);
  text += cells_of(t, [&](std::size_t i) { return t.releases[i].number; });
  text += cells_of(t, [&](std::size_t i) { return easy_questions(t.releases[i]); });
  text += paragraph("easy questions answered rightly, of those answered (engines --check)", margin);
  for (std::size_t n = 0; n < t.rows.size(); ++n) {
    const VersionTable::Row& row = t.rows[n];
    std::string line = cells_of(t, [&](std::size_t i) { return mark_of(row.says[i]); });
    const std::string number = fmt::format("{:>3}", n + 1);
    text += "\n" + line.replace(0, number.size(), number);
    text += paragraph(fmt::format("{}: {}", to_string(row.severity), one_line(row.title)), margin);
    text += paragraph(life_in_words(t, lifetime_of(row.says)), margin);
  }
  const std::string why = reasons(t);
  return why.empty() ? text : text + "\ncannot be asked:\n" + why;
}

std::string versions_markdown(const VersionTable& t) {
  std::string head = "| | cause", line = "|--:|---", easy = "| | *easy questions answered rightly*";
  for (const VersionTable::Release& r : t.releases) {
    head += " | " + r.number;
    line += "|:-:";
    easy += " | " + easy_questions(r);
  }
  std::string text =
      fmt::format("### {} (`{}`)\n\n{} | introduced in | gone since |\n{}|---|---|\n{} | | |\n", t.engine,
                  t.package, head, line, easy);
  for (std::size_t n = 0; n < t.rows.size(); ++n) {
    const VersionTable::Row& row = t.rows[n];
    const Lifetime life = lifetime_of(row.says);
    text += fmt::format("| {} | {}: {}", n + 1, to_string(row.severity), markdown_prose(row.title));
    for (const ReleaseSays& s : row.says)
      text += fmt::format(" | {}", mark_of(s) == "~" ? "\\~" : mark_of(s));
    text += fmt::format(" | {} | {} |\n", introduced(t, life), gone(t, life));
  }
  text += fmt::format("\n{}\n", markdown_prose(legend));
  for (const VersionTable::Release& r : t.releases)
    if (!r.cannot.empty())
      text += fmt::format("\n{} cannot be asked: {}\n", r.number, markdown_prose(r.cannot));
  return text;
}

}  // namespace touchstone::reports
