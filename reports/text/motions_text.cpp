#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "reports/text/record_text.h"
#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::MotionResult;
using fuzz::Motions;

constexpr std::size_t line_width = 79, name_width = 25, cell_width = 9;

std::vector<std::string> engines_of(const Motions& m) {
  std::vector<std::string> names;
  for (const MotionResult& r : m.results)
    if (std::find(names.begin(), names.end(), r.engine) == names.end()) names.push_back(r.engine);
  return names;
}

const MotionResult* result_of(const Motions& m, const std::string& engine, const std::string& motion) {
  for (const MotionResult& r : m.results)
    if (r.engine == engine && r.motion == motion) return &r;
  return nullptr;
}

// An engine whose name is long has a line of its own.
std::string row_name(const std::string& name) {
  if (name.size() + 2 <= name_width) return fmt::format(" {:<{}}", name, name_width - 1);
  return fmt::format(" {}\n{:<{}}", name, "", name_width);
}

std::string table(const Motions& m, const std::string& title,
                  const std::function<std::string(const MotionResult&)>& cell) {
  std::string text = fmt::format("{:<{}}", title, name_width);
  for (const auto& row : m.rows) text += fmt::format("{:>{}}", row.name, cell_width);
  text += '\n';
  for (const std::string& e : engines_of(m)) {
    text += row_name(e);
    for (const auto& row : m.rows) {
      const MotionResult* const r = result_of(m, e, row.name);
      text += fmt::format("{:>{}}", r ? cell(*r) : "", cell_width);
    }
    text += '\n';
  }
  return text + '\n';
}

std::string score_cell(const MotionResult& r) {
  if (r.changes == 0) return "";
  return r.flicker_sum() == 0 ? "0" : fmt::format("{:.3g}", r.score());
}
std::string wrong_cell(const MotionResult& r) {
  const std::uint64_t bad = r.wrong + r.failed, all = r.answers + r.failed;
  if (all == 0) return "";
  return bad == 0 ? "0" : fmt::format("{:.2g}", 100 * static_cast<double>(bad) / static_cast<double>(all));
}
std::string state_cell(const MotionResult& r) { return r.state_asked == 0 ? "" : grouped(r.state_differs); }

// What each engine's flicker consists of.
std::string kinds_table(const Motions& m) {
  std::string text = fmt::format("{:<{}}", "kinds of flicker", name_width);
  const auto wide = [](std::string_view name) { return std::max<std::size_t>(6, name.size() + 1); };
  for (const std::string_view name : flicker_names) text += fmt::format("{:>{}}", name, wide(name));
  text += '\n';
  for (const std::string& e : engines_of(m)) {
    MotionResult sum;
    for (const MotionResult& r : m.results)
      if (r.engine == e) sum.merge(r);
    text += row_name(e);
    for (std::size_t k = 0; k < flicker_count; ++k)
      text += fmt::format("{:>{}}", grouped(sum.flickers[k]), wide(flicker_names[k]));
    text += '\n';
  }
  return text + '\n';
}

// The first piece of evidence of each kind.
std::string evidence_of(const Motions& m, const std::string& engine) {
  std::string text;
  std::vector<std::string> shown;
  for (const MotionResult& r : m.results) {
    if (r.engine != engine) continue;
    for (const fuzz::MotionEvidence& e : r.evidence) {
      if (std::find(shown.begin(), shown.end(), e.kind) != shown.end()) continue;
      shown.push_back(e.kind);
      text += "  " +
              wrapped(fmt::format("{}: {} frame {} of {}, {} of {} and {}: {}", e.kind, e.motion, e.frame,
                                  e.frames, e.question, e.a, e.b, e.words),
                      line_width - 2, 4) +
              "\n";
    }
  }
  return text.empty() ? "" : engine + "\n" + text;
}

}  // namespace

std::string motions_text(const Motions& m) {
  std::string text = wrapped(
      fmt::format("{} of {} frames each. Flicker: changes of an answer from one frame to the next that the "
                  "truth does not make, per thousand. Blank: no answers.",
                  m.count == 1 ? "One motion" : fmt::format("{} motions a column", m.count), m.frames),
      line_width, 0);
  text += "\n\n" + table(m, "flicker", score_cell) + table(m, "wrong or failed, %", wrong_cell) +
          table(m, "state-dependent answers", state_cell) + kinds_table(m);
  for (const std::string& e : engines_of(m)) text += evidence_of(m, e);
  for (const auto& row : m.rows)
    if (!row.line.empty()) text += "  " + wrapped(row.name + ": " + row.line, line_width - 3, 4) + "\n";
  return text;
}

}  // namespace touchstone::reports
