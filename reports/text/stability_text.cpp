#include "reports/text/record_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::LadderResult;

// Rungs are powers of two.
std::string rung(double value) {
  int e = 0;
  if (std::frexp(value, &e) == 0.5 && (value > 4096 || value < 1)) return fmt::format("2^{}", e - 1);
  return fmt::format("{:g}", value);
}

// The text of a table cell: blank, "-" or a rung.
using Cell = std::function<std::string(const std::string& engine, const std::string& ladder)>;

void add_once(std::vector<std::string>& list, const std::string& x) {
  if (std::find(list.begin(), list.end(), x) == list.end()) list.push_back(x);
}

std::string table(const std::string& title, const std::vector<std::string>& engines,
                  const std::vector<std::string>& ladders, const Cell& cell) {
  if (engines.empty()) return "";
  std::string text = fmt::format("{:<23}", title);
  const auto wide = [](const std::string& name) { return std::max<std::size_t>(8, name.size() + 1); };
  for (const auto& l : ladders) text += fmt::format("{:>{}}", l, wide(l));
  text += "\n";
  for (const auto& e : engines) {
    text += fmt::format("{:<23}", " " + e);
    for (const auto& l : ladders) text += fmt::format("{:>{}}", cell(e, l), wide(l));
    text += "\n";
  }
  return text + "\n";
}

std::string question_table(const fuzz::Stability& s, const std::string& question) {
  std::vector<std::string> engines, ladders;
  for (const LadderResult& r : s.results)
    if (r.question == question) {
      add_once(engines, r.engine);
      add_once(ladders, r.ladder);
    }
  return table(question, engines, ladders, [&](const std::string& e, const std::string& l) -> std::string {
    for (const LadderResult& r : s.results)
      if (r.ladder == l && r.engine == e && r.question == question)
        return r.fails_at() ? rung(*r.fails_at()) : "-";
    return "";
  });
}

// Questions about pairs that share a table: the title says what they are about.
constexpr std::string_view of_pairs = "", of_margins = ", margin", of_motions = ", impact";

std::string_view subject_of(const LadderResult& r) {
  const auto question = question_from_string(r.question);
  if (question && is_motion_question(*question)) return of_motions;
  return question && is_margin_question(*question) ? of_margins : of_pairs;
}

// The first rung at which an answer about a pair, to any question of a subject, contradicts that to another
// form of the pair.
std::string form_table(const fuzz::Stability& s, std::size_t form, std::string_view subject) {
  std::vector<std::string> engines, ladders;
  const auto is_of_subject = [&](const LadderResult& r) {
    return r.question != "candidates" && subject_of(r) == subject;
  };
  for (const LadderResult& r : s.results)
    if (is_of_subject(r)) {
      add_once(engines, r.engine);
      add_once(ladders, r.ladder);
    }
  const std::string title = fmt::format("{}{}", fuzz::form_columns[form], subject);
  const bool any = std::any_of(s.results.begin(), s.results.end(), [&](const LadderResult& r) {
    return is_of_subject(r) && r.breaks_at(form).has_value();
  });
  if (!any) return engines.empty() ? "" : title + ": no engine contradicts itself\n\n";
  return table(title, engines, ladders, [&](const std::string& e, const std::string& l) -> std::string {
    const LadderResult* earliest = nullptr;
    bool asked = false;
    const auto index = [&](const LadderResult& r) {
      const auto at = [&](const fuzz::Rung& x) { return x.broken[form] > 0; };
      return std::find_if(r.rungs.begin(), r.rungs.end(), at) - r.rungs.begin();
    };
    for (const LadderResult& r : s.results) {
      if (!is_of_subject(r) || r.ladder != l || r.engine != e) continue;
      asked = true;
      if (r.breaks_at(form) && (!earliest || index(r) < index(*earliest))) earliest = &r;
    }
    return earliest ? rung(*earliest->breaks_at(form)) : asked ? "-" : "";
  });
}

}  // namespace

std::string stability_text(const fuzz::Stability& s) {
  std::string text = wrapped(
      fmt::format(
          "The first rung at which an engine gives a wrong answer or none, over {} cases per rung; -: never, "
          "blank: not supported.",
          s.per_rung),
      79, 0);
  text += "\n\n";
  for (const char* q : {"overlap", "distance", "contact", "within", "bounded_distance", "contact_within",
                        "time_of_impact", "candidates"})
    text += question_table(s, q);
  text += wrapped(
      "The first rung at which two answers about the same pair contradict each other by more than the "
      "engine's own tolerances: A and B exchanged (order); the scene rotated or translated without rounding "
      "(frame); lengths multiplied by 2^20 and 2^-12 (unit).",
      79, 0);
  text += "\n\n";
  for (std::size_t form = 1; form < fuzz::form_count; ++form)
    for (const std::string_view subject : {of_pairs, of_margins, of_motions})
      text += form_table(s, form, subject);
  for (const auto& l : s.ladders) {
    for (const LadderResult& r : s.results)
      if (r.ladder == l.name) {
        text += "  " +
                wrapped(fmt::format("{}: {}, {} to {}{}", l.name, l.line, rung(r.rungs.front().value),
                                    rung(r.rungs.back().value), l.unit.empty() ? "" : " " + l.unit),
                        76, 4) +
                "\n";
        break;
      }
  }
  return text;
}

}  // namespace touchstone::reports
