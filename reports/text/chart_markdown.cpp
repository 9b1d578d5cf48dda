#include "reports/text/record_text.h"

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

// Engines as shipped, by question, our own first; for time of impact also the other methods.
struct Part {
  const char *question, *words;
  std::vector<std::string_view> engines;
};
const Part parts[] = {
    {"overlap",
     "overlap",
     {"core", "core-f32", "fcl-libccd", "bullet-f64-query", "libccd-gjk", "libccd-mpr", "ode", "dart",
      "mujoco2", "mujoco", "physx-query", "havok", "jolt", "rapier"}},
    {"distance",
     "distance",
     {"core", "core-f32", "fcl-libccd", "bullet-f64-query", "mujoco", "physx-gjk", "havok", "jolt",
      "rapier"}},
    {"contact",
     "contact",
     {"core", "core-f32", "fcl-libccd", "bullet-f64-query", "libccd-gjk", "libccd-mpr", "ode", "dart",
      "mujoco2", "mujoco", "physx-gjk", "havok", "jolt", "rapier"}},
    {"within",
     "within a margin",
     {"core", "bullet-f64-query", "mujoco2", "mujoco", "physx-gjk", "physx-sim", "jolt", "rapier"}},
    {"bounded_distance", "distance up to a margin", {"core", "mujoco", "physx-gjk", "jolt", "rapier"}},
    {"contact_within",
     "contact within a margin",
     {"core", "bullet-f64-query", "mujoco2", "mujoco", "physx-gjk", "physx-sim", "jolt", "rapier"}},
    {"ray", "ray", {"core", "bullet-f64-query", "ode"}},
    {"time_of_impact",
     "impact",
     {"core", "core-steps@16", "core-steps@256", "fcl-libccd", "fcl-libccd-tuned", "bullet-f64-query",
      "physx-query", "havok", "jolt", "rapier"}},
    {"candidates",
     "candidates",
     {"automatic", "neighbour_list", "fcl-dynamic-tree", "fcl-ssap", "bullet-f64-dbvt", "ode-sap"}},
};

// How the libraries of engines that run as WebAssembly end, and how those engines are marked.
constexpr std::string_view wasm_ending = ", WASM", wasm_word = "WASM";

constexpr const char* wasm_words =
    "Engines marked WASM run as WebAssembly under Node; their times include the calls from JavaScript. ";

bool runs_as_wasm(const fuzz::ChartEngine& e) { return e.library.ends_with(wasm_ending); }

bool is_core(const ChartRow& r) {
  return r.question == "candidates" ? r.engine == "automatic" : r.engine == "core";
}

// A row over all regimes, pairs and scales; for candidates, the row of the largest crowd that all engines of
// the part answered.
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
  std::stable_sort(rows.begin(), rows.end(), [](const ChartRow& a, const ChartRow& b) {
    return std::pair(!is_timed(a), a.ns_median) < std::pair(!is_timed(b), b.ns_median);
  });
  return rows;
}

// The core's broad phases are named without "core"; this adds it.
std::string name_of(const Chart& c, const ChartRow& r) {
  if (r.question == "candidates" && (r.engine == "automatic" || r.engine == "neighbour_list"))
    return "core (" + r.engine + ")";
  return is_wasm(c, r) ? fmt::format("{} ({})", r.engine, wasm_word) : r.engine;
}

std::string line(const Chart& c, const ChartRow& r, const std::string& asked) {
  const bool crowd = r.question == "candidates";
  const std::string name = is_core(r) ? "**" + name_of(c, r) + "**" : name_of(c, r);
  const std::string worst = crowd ? fmt::format("{:.0f} % true", 100 * r.precision()) : small(r.error_max);
  // For candidates a ghost is not a fault.
  const std::uint64_t ghosts = crowd ? 0 : r.ghost, verdicts = r.missed + ghosts;
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", asked, name,
                     is_timed(r) ? nanoseconds(r.ns_median) : "pipe",
                     is_timed(r) ? nanoseconds(r.ns_p99) : "pipe", worst, grouped(r.missed),
                     crowd ? "" : grouped(ghosts), grouped(r.wrong - std::min(r.wrong, verdicts)),
                     grouped(r.failed), grouped(r.answers + r.failed));
}

// "PhysX 5.6.1, WASM" and "2.7.3": "PhysX 5.6.1 (WASM 2.7.3)".
std::string library_words(const fuzz::ChartEngine& e) {
  if (!runs_as_wasm(e)) return e.library + " " + e.version;
  return fmt::format("{} ({} {})", e.library.substr(0, e.library.size() - wasm_ending.size()), wasm_word,
                     e.version);
}

std::string versions(const Chart& c) {
  std::set<std::string> all;
  for (const fuzz::ChartEngine& e : c.engines)
    if (e.library != "Touchstone core" && !e.library.empty()) all.insert(library_words(e));
  return fmt::format("{}", fmt::join(all, ", "));
}

// The engines with a lower median time than the core, by question.
std::string faster(const Chart& c) {
  std::string text;
  for (const Part& part : parts) {
    const auto rows = rows_of(c, part);
    const auto core = std::find_if(rows.begin(), rows.end(), is_core);
    if (core == rows.end()) continue;
    std::string names;
    for (auto r = rows.begin(); r != core; ++r) {
      names += (names.empty() ? "" : ", ") + name_of(c, *r);
      if (!r->unsound.empty()) names += fmt::format(" ({})", r->unsound);
    }
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", part.words, names.empty() ? "none" : names);
  }
  return text;
}

}  // namespace

bool is_wasm(const Chart& c, const ChartRow& row) {
  return std::any_of(c.engines.begin(), c.engines.end(),
                     [&](const fuzz::ChartEngine& e) { return e.name == row.engine && runs_as_wasm(e); });
}

std::vector<std::string> engines_of_excerpt() {
  std::vector<std::string> names;
  for (const Part& part : parts)
    for (const std::string_view name : part.engines)
      if (part.question != std::string_view("candidates") &&
          std::find(names.begin(), names.end(), name) == names.end())
        names.emplace_back(name);
  return names;
}

Chart chart_excerpt(const Chart& c) {
  Chart excerpt = c;
  excerpt.rows.clear();
  excerpt.engines.clear();
  std::set<std::string> named;
  for (const Part& part : parts)
    for (const ChartRow& r : rows_of(c, part)) {
      excerpt.rows.push_back(r);
      named.insert(r.engine);
    }
  for (const fuzz::ChartEngine& e : c.engines)
    if (named.contains(e.name)) excerpt.engines.push_back(e);
  return excerpt;
}

std::string chart_markdown(const Chart& c) {
  std::string s =
      "| question | engine | median ns | 99 % ns | worst error / L | missed | ghosts | otherwise wrong | no "
      "answer | queries |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  std::uint64_t crowd = 0;
  for (const Part& part : parts) {
    std::string asked = part.words;
    for (const ChartRow& r : rows_of(c, part)) {
      s += line(c, r, std::exchange(asked, ""));
      if (r.question == "candidates") crowd = r.bodies;
    }
  }
  const bool any_wasm = std::any_of(c.engines.begin(), c.engines.end(), runs_as_wasm);
  const std::string words = fmt::format(
      "Engines with a lower median time than the core: {}. Measured {} on {}, {} cores, load {:.1f}, "
      "compiler {}, {}; {} chart, seed {}, {} interleaved rounds; candidates: {} bodies, inserted and "
      "queried once. Engines are as shipped; `fcl-libccd-tuned` is FCL's conservative advancement, "
      "`core-steps@16` the core's overlap test at 17 times of the step. {}Errors are measured by the referee "
      "and divided by the scale L of the scene; an answer is wrong if its error exceeds the tolerance "
      "claimed "
      "in the engine's own documentation. All settings and groups: `./touchstone chart`; these numbers: "
      "`docs/chart.json`.",
      faster(c), c.machine.date, c.machine.processor, c.machine.cores, c.machine.load, c.machine.compiler,
      versions(c), c.scope, c.seed, c.rounds, grouped(crowd), any_wasm ? wasm_words : "");
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
