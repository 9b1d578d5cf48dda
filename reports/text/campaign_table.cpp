// The table of a campaign on one screen: one row an engine, shipped and tuned settings in one cell.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using Tallies = std::map<Question, fuzz::Tally>;

struct Column {
  Question question;
  std::string_view title;
};
// In the order in which an engine works; titles fit the width of a cell.
constexpr auto columns = std::to_array<Column>({{Question::overlap, "overlap"},
                                                {Question::distance, "dist"},
                                                {Question::contact, "contact"},
                                                {Question::time_of_impact, "impact"},
                                                {Question::candidates, "pairs"},
                                                {Question::scene_contacts, "scene"},
                                                {Question::swept_candidates, "swept"}});
static_assert(columns.size() == question_names.size());

// An engine as shipped and, if there is one, the same engine with tuned settings.
struct TableRow {
  std::string name;
  const Tallies* shipped = nullptr;
  const Tallies* tuned = nullptr;
};

std::uint64_t answers_to(const Tallies* t, Question q) {
  if (!t) return 0;
  const auto found = t->find(q);
  return found == t->end() ? 0 : found->second.answered() + found->second.failed();
}

std::uint64_t answers_of(const Tallies* t) {
  std::uint64_t n = 0;
  for (const Column& c : columns) n += answers_to(t, c.question);
  return n;
}

std::vector<TableRow> table_rows(const fuzz::CampaignResult& r) {
  constexpr std::string_view suffix = "-tuned";
  std::vector<TableRow> rows;
  for (const auto& [engine, tallies] : r.tallies) {
    const bool tuned = engine.ends_with(suffix);
    const std::string shipped = tuned ? engine.substr(0, engine.size() - suffix.size()) : engine;
    if (tuned && r.tallies.contains(shipped)) continue;  // in the row of that engine
    const auto other = r.tallies.find(engine + std::string(suffix));
    rows.push_back({engine, &tallies, other == r.tallies.end() ? nullptr : &other->second});
  }
  return rows;
}

// Three characters at most. Only 0 is written as "0", and only all as "100".
std::string percent(std::uint64_t part, std::uint64_t of) {
  if (of == 0) return "-";
  if (part == 0) return "0";
  if (part >= of) return "100";
  constexpr double least = 0.05, one_decimal_below = 9.95, most = 99;  // in %, where the rounding changes
  const double x = 100.0 * static_cast<double>(part) / static_cast<double>(of);
  if (x < least) return "<.1";
  return x < one_decimal_below ? fmt::format("{:.1f}", x) : fmt::format("{:.0f}", std::min(x, most));
}

std::string percent_wrong(const Tallies* t, Question q) {
  const std::uint64_t answers = answers_to(t, q);
  if (answers == 0) return "-";
  const fuzz::Tally& tally = t->at(q);
  return percent(tally.wrong + tally.failed(), answers);
}

std::string cell(const TableRow& row, Question q) {
  const std::string shipped = percent_wrong(row.shipped, q);
  if (!row.tuned) return shipped;
  const std::string tuned = percent_wrong(row.tuned, q);
  return shipped == "-" && tuned == "-" ? shipped : shipped + "/" + tuned;
}

// In at most 7 characters.
std::string short_count(std::uint64_t n) {
  constexpr std::uint64_t mega = 1'000'000, giga = 1'000'000'000;  // prefixes of the SI
  if (n < mega) return grouped(n);
  return n < giga ? grouped(n / 1000) + "k" : fmt::format("{:.1e}", static_cast<double>(n));
}

constexpr std::size_t name_width = 16, answers_width = 8, cell_width = 8, table_width = 80;

}  // namespace

std::string campaign_table(const fuzz::CampaignResult& r) {
  const std::vector<TableRow> rows = table_rows(r);
  std::vector<Column> shown;
  bool any_tuned = false;
  for (const TableRow& row : rows) any_tuned |= row.tuned != nullptr;
  for (const Column& c : columns)
    if (std::any_of(rows.begin(), rows.end(), [&](const TableRow& row) {
          return answers_to(row.shipped, c.question) + answers_to(row.tuned, c.question) > 0;
        }))
      shown.push_back(c);
  std::string s =
      fmt::format("Wrong and failed answers in %{} (-: no answers)\n{:<{}}{:>{}}",
                  any_tuned ? ", as shipped/tuned" : "", "", name_width, "answers", answers_width);
  for (const Column& c : shown) s += fmt::format("{:>{}}", c.title, cell_width);
  s += "\n";
  for (const TableRow& row : rows) {
    const std::string name = printable(row.name);
    if (name.size() > name_width)
      s += cut_utf8(name, table_width - 1) + "\n" + std::string(name_width, ' ');
    else
      s += fmt::format("{:<{}}", name, name_width);
    s += fmt::format("{:>{}}", short_count(answers_of(row.shipped) + answers_of(row.tuned)), answers_width);
    for (const Column& c : shown) s += fmt::format("{:>{}}", cell(row, c.question), cell_width);
    s += "\n";
  }
  return s;
}

}  // namespace touchstone::reports
