#include "reports/text/chart_markdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/base/input_error.h"
#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::Chart;
using fuzz::ChartRow;

// Engines as shipped, by question, our own first; of time of impact also the other ways of asking.
struct Part {
  const char *question, *words;
  std::vector<std::string_view> engines;
};
const Part parts[] = {
    {"overlap",
     "overlap",
     {"core", "core-f32", "fcl-libccd", "bullet-f64-query", "libccd-gjk", "libccd-mpr", "ode"}},
    {"distance", "distance", {"core", "core-f32", "fcl-libccd", "bullet-f64-query"}},
    {"contact",
     "contact",
     {"core", "core-f32", "fcl-libccd", "bullet-f64-query", "libccd-gjk", "libccd-mpr", "ode"}},
    {"time_of_impact",
     "impact",
     {"core", "core-steps@16", "core-steps@256", "fcl-libccd", "fcl-libccd-tuned", "bullet-f64-query"}},
    {"candidates",
     "candidates",
     {"automatic", "neighbour_list", "fcl-dynamic-tree", "fcl-ssap", "bullet-f64-dbvt", "ode-sap"}},
};

bool is_core(const ChartRow& r) {
  return r.question == "candidates" ? r.engine == "automatic" : r.engine == "core";
}

// A row of all regimes, pairs and scales; of candidates that of the largest crowd which all of the part
// answered.
bool is_overall(const ChartRow& r, std::uint64_t crowd) {
  if (!r.pair.empty() || !r.scale.empty() || r.answers == 0) return false;
  return r.question == "candidates" ? r.bodies == crowd && !r.regime.empty() : r.regime.empty();
}

std::uint64_t crowd_of(const Chart& c, const Part& part) {
  std::set<std::uint64_t> sizes;
  for (const ChartRow& r : c.rows)
    if (r.question == "candidates") sizes.insert(r.bodies);
  for (auto n = sizes.rbegin(); n != sizes.rend(); ++n) {
    const auto has = [&](std::string_view e) {
      return std::any_of(c.rows.begin(), c.rows.end(), [&](const ChartRow& r) {
        return r.question == "candidates" && r.bodies == *n && r.engine == e && r.answers > 0;
      });
    };
    if (std::all_of(part.engines.begin(), part.engines.end(), has)) return *n;
  }
  return sizes.empty() ? 0 : *sizes.rbegin();
}

std::vector<ChartRow> rows_of(const Chart& c, const Part& part) {
  const std::uint64_t crowd = crowd_of(c, part);
  std::vector<ChartRow> rows;
  for (const ChartRow& r : c.rows)
    if (r.question == part.question && is_overall(r, crowd) &&
        std::find(part.engines.begin(), part.engines.end(), r.engine) != part.engines.end())
      rows.push_back(r);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const ChartRow& a, const ChartRow& b) { return a.ns_median < b.ns_median; });
  return rows;
}

// The core's broad phases have names without its own.
std::string name_of(const ChartRow& r) {
  if (r.question == "candidates" && (r.engine == "automatic" || r.engine == "neighbour_list"))
    return "core (" + r.engine + ")";
  return r.engine;
}

std::string line(const ChartRow& r, const std::string& asked) {
  const bool crowd = r.question == "candidates";
  const std::string name = is_core(r) ? "**" + name_of(r) + "**" : name_of(r);
  const std::string worst = crowd ? fmt::format("{:.0f} % true", 100 * r.precision()) : small(r.error_max);
  // Of candidates a ghost is no fault.
  const std::uint64_t ghosts = crowd ? 0 : r.ghost, verdicts = r.missed + ghosts;
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", asked, name,
                     nanoseconds(r.ns_median), nanoseconds(r.ns_p99), worst, grouped(r.missed),
                     crowd ? "" : grouped(ghosts), grouped(r.wrong - std::min(r.wrong, verdicts)),
                     grouped(r.failed), grouped(r.answers + r.failed));
}

std::string versions(const Chart& c) {
  std::set<std::string> all;
  for (const fuzz::ChartEngine& e : c.engines)
    if (e.library != "Touchstone core" && !e.library.empty()) all.insert(e.library + " " + e.version);
  return fmt::format("{}", fmt::join(all, ", "));
}

// Who is faster than the core by the median, question by question.
std::string faster(const Chart& c) {
  std::string text;
  for (const Part& part : parts) {
    const auto rows = rows_of(c, part);
    const auto core = std::find_if(rows.begin(), rows.end(), is_core);
    if (core == rows.end()) continue;
    std::string names;
    for (auto r = rows.begin(); r != core; ++r) {
      names += (names.empty() ? "" : ", ") + name_of(*r);
      if (!r->unsound.empty()) names += fmt::format(" ({})", r->unsound);
    }
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", part.words, names.empty() ? "nobody" : names);
  }
  return text;
}

}  // namespace

Chart chart_excerpt(const Chart& c) {
  Chart excerpt = c;
  excerpt.rows.clear(), excerpt.engines.clear();
  std::set<std::string> named;
  for (const Part& part : parts)
    for (const ChartRow& r : rows_of(c, part)) excerpt.rows.push_back(r), named.insert(r.engine);
  for (const fuzz::ChartEngine& e : c.engines)
    if (named.contains(e.name)) excerpt.engines.push_back(e);
  return excerpt;
}

std::string chart_markdown(const Chart& c) {
  std::string s =
      "| asked | engine | median ns | 99 % ns | worst error / L | missed | ghosts | otherwise wrong | no "
      "answer | of |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  std::uint64_t crowd = 0;
  for (const Part& part : parts) {
    std::string asked = part.words;
    for (const ChartRow& r : rows_of(c, part)) {
      s += line(r, std::exchange(asked, ""));
      if (r.question == "candidates") crowd = r.bodies;
    }
  }
  const std::string words = fmt::format(
      "Faster than the core by the median: {}. Measured {} on {}, {} cores, load {:.1f}, compiler {}, {}; {} "
      "chart, seed {}, {} interleaved rounds, candidates of {} bodies, inserted and asked once. Engines as "
      "shipped; `fcl-libccd-tuned` is FCL's conservative advancement, `core-steps@16` the core's overlap at "
      "17 "
      "times of the step. Errors are the referee's over the size L of the scene; wrong is what exceeds the "
      "tolerance that the engine's own documentation claims. Every setting and group: `./touchstone chart`; "
      "these numbers: `docs/chart.json`.",
      faster(c), c.machine.date, c.machine.processor, c.machine.cores, c.machine.load, c.machine.compiler,
      versions(c), c.scope, c.seed, c.rounds, grouped(crowd));
  return s + "\n" + wrapped(words, 125, 0) + "\n";
}

std::string with_chart_block(const std::string& text, const std::string& block, const std::string& file) {
  const auto begin = text.find(chart_begin), end = text.find(chart_end);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw InputError(file, "has no lines '<!-- chart: generated -->' and '<!-- chart: end -->'");
  const std::size_t from = begin + std::string(chart_begin).size();
  return text.substr(0, from) + block + text.substr(end);
}

}  // namespace touchstone::reports
