#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>

#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using namespace fuzz;

constexpr std::size_t text_width = 79;
constexpr double millimetres = 1000;  // of a metre, the unit of robots
/// In millimetres; errors below an atom's size are shown as smaller than this.
constexpr double least_shown_millimetres = 1e-6;

std::string in_millimetres(double metres) {
  const double mm = metres * millimetres;
  if (mm == 0) return "0";
  return mm < least_shown_millimetres ? "<1e-6" : fmt::format("{:.3g}", mm);
}

std::string count_of(std::uint64_t n) { return n == 0 ? "0" : grouped(n); }

const Tally& tally_of(const AssessedEngine& e, Question q) {
  static const Tally none;
  const auto it = e.tallies.find(q);
  return it == e.tallies.end() ? none : it->second;
}

std::uint64_t without_answer(const Tally& t) { return t.failed() + t.unsupported() + t.not_asked(); }

std::string time_of(const Tally& t) { return t.answered() > 0 ? duration(t.time.quantile(0.5)) : "-"; }

std::string padding_of(const AssessedEngine& e) {
  if (tally_of(e, Question::overlap).answered() == 0) return "-";
  if (e.silent > 0) return "unknown";
  return e.denied > 0 && e.padding == 0 ? "distance" : in_millimetres(e.padding);
}

// In columns of a terminal, for text without wide characters.
std::size_t width_of(const std::string& text) {
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; };
  return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues));
}

constexpr std::size_t column_count = 8;
using Row = std::array<std::string, column_count>;

Row row_of(const AssessedEngine& e) {
  const Tally &o = tally_of(e, Question::overlap), &d = tally_of(e, Question::distance);
  return {count_of(e.missed),
          count_of(e.false_alarms),
          count_of(without_answer(o)),
          time_of(o),
          e.distances_apart > 0 ? in_millimetres(e.worst_distance_error) : "-",
          count_of(without_answer(d)),
          time_of(d),
          padding_of(e)};
}

// Names that do not fit beside their numbers stand on a line of their own.
std::string table(const Assessment& a) {
  const Row headings{"missed", "false", "none", "time", "worst", "none", "time", "padding"};
  std::vector<Row> rows;
  std::size_t name_width = 6;
  for (const AssessedEngine& e : a.engines) {
    rows.push_back(row_of(e));
    name_width = std::max(name_width, printable(e.name).size());
  }
  std::array<std::size_t, column_count> widths{};
  std::size_t numbers = 0;
  for (std::size_t c = 0; c < column_count; ++c) {
    widths[c] = headings[c].size() + 1;
    for (const Row& r : rows) widths[c] = std::max(widths[c], width_of(r[c]) + 1);
    numbers += widths[c];
  }
  name_width = std::min(name_width, text_width - std::min(numbers, text_width - 1));
  const auto cells = [&](const Row& r) {
    std::string text;
    for (std::size_t c = 0; c < column_count; ++c) text += fmt::format("{:>{}}", r[c], widths[c]);
    return text + "\n";
  };
  const std::size_t of_test = widths[0] + widths[1] + widths[2] + widths[3],
                    of_distance = widths[4] + widths[5] + widths[6];
  std::string text = fmt::format("{:{}} {:-^{}} {:-^{}}\n", "", name_width, " collision test ", of_test - 1,
                                 " distance, mm ", of_distance - 1);
  text += fmt::format("{:<{}}", "engine", name_width) + cells(headings);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string name = printable(a.engines[i].name);
    text += name.size() > name_width ? name + "\n" + std::string(name_width, ' ')
                                     : fmt::format("{:<{}}", name, name_width);
    text += cells(rows[i]);
  }
  return text;
}

std::string heading_of(const Assessment& a) {
  std::string text =
      fmt::format("{}{}: ", printable(a.robot), a.world.empty() ? "" : " in " + printable(a.world));
  text += a.of_trajectory ? fmt::format("{} of a trajectory. ", counted(a.configurations, "row", "rows"))
                          : fmt::format("{} drawn at random (seed {}). ",
                                        counted(a.configurations, "configuration", "configurations"), a.seed);
  text += fmt::format("{} can collide in each. Pairs with boxes nearer than {} mm: {}",
                      counted(a.possible, "pair", "pairs"), in_millimetres(a.near), grouped(a.near_pairs));
  text += a.asked < a.near_pairs ? fmt::format(", of which {} were asked", grouped(a.asked)) : ", all asked";
  text += fmt::format("; {} collide, {} do not{}.", grouped(a.overlapping), grouped(a.apart),
                      a.undecided > 0 ? fmt::format(" ({} undecided)", grouped(a.undecided)) : "");
  if (a.interrupted) text += " Interrupted before all pairs were asked.";
  return text;
}

using Paragraphs = std::vector<std::string>;

Paragraphs legend_of(const Assessment& a) {
  Paragraphs text;
  text.push_back(fmt::format(
      "missed: collisions deeper than {0} mm that are denied (of meshes, which have no depth: all); false: "
      "collisions reported of bodies more than {0} mm apart (--error changes both); none: pairs without an "
      "answer; worst: largest error of a distance between bodies that are apart; time: median of a query; "
      "padding: the least with which \"collision, or distance at most the padding\" misses no collision that "
      "was asked, in mm.",
      in_millimetres(a.error)));
  const auto has = [&](const std::string& padding) {
    return std::any_of(a.engines.begin(), a.engines.end(),
                       [&](const AssessedEngine& e) { return padding_of(e) == padding; });
  };
  if (has("distance"))
    text.emplace_back(
        "padding \"distance\": the collision test misses some, and a distance of 0 finds them.");
  if (has("unknown"))
    text.emplace_back(
        "padding \"unknown\": the engine states no distance for a collision that its test denies.");
  return text;
}

// Engines with the same words share them.
void add_note(Paragraphs& to, const Assessment& a, const std::string& what,
              const std::function<std::string(const AssessedEngine&)>& words_for) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const AssessedEngine& e : a.engines) {
    const std::string words = words_for(e);
    if (words.empty()) continue;
    const auto it =
        std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == words; });
    if (it == groups.end())
      groups.push_back({words, {printable(e.name)}});
    else
      it->second.push_back(printable(e.name));
  }
  std::vector<std::string> parts;
  for (const auto& [words, names] : groups)
    parts.push_back(fmt::format("{}: {}", fmt::join(names, ", "), words));
  if (!parts.empty()) to.push_back(fmt::format("{} {}.", what, fmt::join(parts, "; ")));
}

std::string kinds_unanswered(const AssessedEngine& e) {
  std::vector<std::string> parts;
  for (const auto& [kinds, count] : e.unanswered)
    parts.push_back(fmt::format("{} {}", kinds, grouped(count)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string grazing(const AssessedEngine& e) {
  return e.denied > e.missed ? grouped(e.denied - e.missed) : "";
}

std::string far_apart(const AssessedEngine& e) {
  return e.false_alarms > 0 ? fmt::format("up to {} mm", in_millimetres(e.largest_gap)) : "";
}

std::string beyond_claim(const AssessedEngine& e) {
  const std::uint64_t d = tally_of(e, Question::distance).wrong, c = tally_of(e, Question::contact).wrong;
  std::vector<std::string> parts;
  if (d > 0) parts.push_back(counted(d, "distance", "distances"));
  if (c > 0) parts.push_back(counted(c, "contact", "contacts"));
  return fmt::format("{}", fmt::join(parts, " and "));
}

Paragraphs notes_of(const Assessment& a) {
  Paragraphs text;
  add_note(text, a, "No answer by kinds of shapes:", kinds_unanswered);
  add_note(text, a, "False collisions, apart by:", far_apart);
  add_note(text, a, "Denied collisions that are shallower:", grazing);
  add_note(text, a, "Wrong by more than the engine states:", beyond_claim);
  return text;
}

std::string false_words(std::uint64_t false_alarms) {
  return false_alarms == 0
             ? ""
             : fmt::format(" and {}", counted(false_alarms, "false collision", "false collisions"));
}

std::string test_words(const TestAdvice& x) {
  if (!x.by_distance)
    return fmt::format("{} misses no collision that was asked, without padding{}; {} a test", x.engine,
                       false_words(x.false_alarms), duration(x.median_ns));
  return fmt::format(
      "{} misses no collision that was asked if bodies at most {} mm apart by its distance count as "
      "colliding "
      "(its collision test alone misses some); {} a distance",
      x.engine, in_millimetres(x.padding), duration(x.median_ns));
}

std::string distance_words(const DistanceAdvice& x, double error) {
  return x.worst_error <= error
             ? fmt::format(
                   "{} is the fastest with errors of at most {} mm; its worst is {} mm, and a query "
                   "takes {}",
                   x.engine, in_millimetres(error), in_millimetres(x.worst_error), duration(x.median_ns))
             : fmt::format("none has errors of at most {} mm; {} has the least, {} mm, and a query takes {}",
                           in_millimetres(error), x.engine, in_millimetres(x.worst_error),
                           duration(x.median_ns));
}

// The first of the list that is no engine of ours, and ours beside it.
template <class Advice, class Words>
std::string best_words(const std::vector<Advice>& list, const std::string& none, const Words& words) {
  const auto own = std::find_if(list.begin(), list.end(), [](const Advice& x) { return x.is_own; });
  const auto other = std::find_if(list.begin(), list.end(), [](const Advice& x) { return !x.is_own; });
  std::string text = other == list.end() ? none : words(*other);
  text += ".";
  if (own != list.end()) text += fmt::format(" Touchstone's own core: {}.", words(*own));
  return text;
}

Paragraphs advice_of(const Assessment& a) {
  if (a.asked == 0) return {"None: no pair was asked."};
  Paragraphs text;
  if (a.overlapping == 0)
    text.emplace_back(
        "Collision tests: nothing that was asked collides, so this run says nothing about missed collisions. "
        "Ask more configurations (--samples), or others (--trajectory).");
  else
    text.push_back("Collision tests: " +
                   best_words(test_advice(a),
                              "no engine answers every pair with a padding that misses no collision",
                              test_words));
  if (a.apart > 0)
    text.push_back("Distances: " +
                   best_words(distance_advice(a), "no engine states one for every pair that is apart",
                              [&](const DistanceAdvice& x) { return distance_words(x, a.error); }));
  if (std::any_of(a.engines.begin(), a.engines.end(), [](const auto& e) { return e.is_own; }))
    text.emplace_back("The core is a C++ library as well, which a program can use: docs/core-library.md.");
  text.emplace_back("This holds for what was asked, not for every configuration.");
  return text;
}

std::string wrapped_all(const Paragraphs& text) {
  std::string all;
  for (const std::string& p : text) all += wrapped(p, text_width, 2) + "\n";
  return all;
}

}  // namespace

AssessmentWords assessment_words(const Assessment& a) {
  return {heading_of(a), legend_of(a), notes_of(a), advice_of(a)};
}

std::string assessment_text(const Assessment& a) {
  const AssessmentWords w = assessment_words(a);
  return wrapped(w.heading, text_width, 2) + "\n\n" + table(a) + "\n" + wrapped_all(w.legend) +
         wrapped_all(w.notes) + "\n" + wrapped_all(w.advice);
}

}  // namespace touchstone::reports
