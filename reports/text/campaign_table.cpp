// The table of a campaign on one screen: one row an engine, shipped and tuned settings in one cell.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using Tallies = std::map<Question, fuzz::Tally>;

// A question, and one of the same kind that is counted with it: eight columns would not fit.
struct Column {
  Question question;
  std::string_view title;
  std::optional<Question> with = std::nullopt;
};
// In the order in which an engine works; titles fit the width of a cell.
constexpr auto question_columns =
    std::to_array<Column>({{Question::overlap, "overlap", Question::within},
                           {Question::distance, "dist", Question::bounded_distance},
                           {Question::contact, "contact", Question::contact_within},
                           {Question::time_of_impact, "impact", Question::ray},
                           {Question::candidates, "pairs", Question::candidates_within},
                           {Question::scene_contacts, "scene"},
                           {Question::swept_candidates, "swept"}});
constexpr std::size_t questions_in_columns() {
  std::size_t n = 0;
  for (const Column& c : question_columns) n += c.with ? 2 : 1;
  return n;
}
static_assert(questions_in_columns() == question_names.size());

// An engine as shipped and, if there is one, the same engine with tuned settings.
struct TableRow {
  std::string name;
  const Tallies* shipped = nullptr;
  const Tallies* tuned = nullptr;
};

struct Count {
  std::uint64_t answers = 0, wrong = 0;
};

Count count_of(const Tallies* t, const Column& c) {
  Count n;
  if (!t) return n;
  for (const auto& [question, tally] : *t)
    if (question == c.question || question == c.with) {
      n.answers += tally.answered() + tally.failed();
      n.wrong += tally.wrong + tally.failed();
    }
  return n;
}

std::uint64_t answers_to(const Tallies* t, const Column& c) { return count_of(t, c).answers; }

std::uint64_t answers_of(const Tallies* t) {
  std::uint64_t n = 0;
  for (const Column& c : question_columns) n += answers_to(t, c);
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

std::string percent_wrong(const Tallies* t, const Column& c) {
  const Count n = count_of(t, c);
  return n.answers == 0 ? "-" : percent(n.wrong, n.answers);
}

std::string cell(const TableRow& row, const Column& c) {
  const std::string shipped = percent_wrong(row.shipped, c);
  if (!row.tuned) return shipped;
  const std::string tuned = percent_wrong(row.tuned, c);
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
  for (const Column& c : question_columns)
    if (std::any_of(rows.begin(), rows.end(), [&](const TableRow& row) {
          return answers_to(row.shipped, c) + answers_to(row.tuned, c) > 0;
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
    for (const Column& c : shown) s += fmt::format("{:>{}}", cell(row, c), cell_width);
    s += "\n";
  }
  return s;
}

}  // namespace touchstone::reports
