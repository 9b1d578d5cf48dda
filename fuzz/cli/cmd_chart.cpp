#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/comma_list.h"
#include "core/scene/input_file.h"
#include "fuzz/campaign/store.h"
#include "fuzz/cli/broad_subject.h"
#include "fuzz/cli/command.h"
#include "fuzz/cli/engine_catalog.h"
#include "fuzz/cli/pages.h"
#include "fuzz/cli/sweep_catalog.h"
#include "fuzz/explore/chart.h"
#include "fuzz/explore/sub_steps.h"
#include "oracles/api/measure.h"
#include "oracles/core/broad_engine.h"
#include "reports/chart_markdown.h"
#include "reports/chart_text.h"

namespace touchstone::cli {
namespace {

struct ChartOptions {
  std::string engines = "all", broad = "all", subject = "core", out = "out/chart", from, readme;
  std::uint64_t seed = 1;
  std::int64_t measure = 20'000;
  bool quick = false, json = false;
  WorkerLimits limits;
};

// A crowd of thousands is one question.
constexpr double crowd_cpu_seconds = 10;

std::vector<EnginePtr> broad_engines(const ChartOptions& o) {
  WorkerLimits limits = o.limits;
  limits.query_cpu_seconds = std::max(limits.query_cpu_seconds, crowd_cpu_seconds);
  std::vector<std::string> names;
  if (o.broad == "all") {
    for (std::string_view name : core_broad_phases()) names.emplace_back(name);
    for (const EngineRow& row : broad_catalog())
      if (is_present(row)) names.emplace_back(row.name);
  } else if (!o.broad.empty()) {
    for_each_in_list(o.broad, [&](std::string_view name) { names.emplace_back(name); });
  }
  std::vector<EnginePtr> engines;
  for (const auto& name : names)
    engines.push_back(broad_subject(name, limits, false).make(fuzz::Level::bodies));
  return engines;
}

// The engines named; of all of them other settings too, and sub-stepping.
std::vector<EnginePtr> pair_engines(const ChartOptions& o) {
  std::vector<EnginePtr> engines;
  const bool all = o.engines == "all";
  // core-kept builds for one question what a program builds once: its times say nothing.
  for (const auto& name : engine_names(o.engines))
    if (!all || name != "core-kept") engines.push_back(make_engine(name, o.limits));
  if (!all) return engines;
  for (const EngineRow& row : sweep_catalog())
    if (is_present(row)) engines.push_back(make_engine(std::string(row.name), o.limits));
  const auto stepped = stepped_engines();
  for (const EngineRow& row : engine_catalog()) {
    if (!is_present(row) || std::find(stepped.begin(), stepped.end(), row.name) == stepped.end()) continue;
    const std::shared_ptr<Engine> inner = make_engine(std::string(row.name), o.limits);
    for (const int steps : step_counts) engines.push_back(fuzz::sub_stepped(inner, steps));
  }
  return engines;
}

fuzz::Chart measured(const ChartOptions& o) {
  const bool live = isatty(2) == 1;
  // Before any engine is made: its worker inherits it.
  setenv(measure_variable, std::to_string(o.measure).c_str(), 1);
  const auto engines = pair_engines(o);
  const auto broad = broad_engines(o);
  fuzz::Chart chart = fuzz::measure_chart(o.quick ? fuzz::quick_chart() : fuzz::full_chart(), o.seed, engines,
                                          broad, [live](const std::string& what) {
                                            if (live) fmt::print(stderr, "\r\033[K{}", what);
                                          });
  if (live) fmt::print(stderr, "\r\033[K");
  return chart;
}

fuzz::Chart stored(const std::string& file) {
  const auto j = nlohmann::json::parse(read_file(file, std::uintmax_t{1} << 28), nullptr, false);
  return fuzz::chart_from_json(j, file);
}

// Its numbers are kept beside it, so that a test can hold the one against the other: the block is made of
// what is kept, which has fewer digits than what was measured.
void write_readme(const std::filesystem::path& readme, const fuzz::Chart& chart) {
  const std::string before = read_file(readme, std::uintmax_t{1} << 24);
  const auto docs = readme.parent_path() / "docs";
  fuzz::make_directory(docs.string());
  const auto kept = docs / "chart.json";
  write_file(kept, fuzz::to_json(reports::chart_excerpt(chart)).dump() + "\n");
  const std::string block = reports::chart_markdown(stored(kept.string()));
  write_file(readme, reports::with_chart_block(before, block, readme.string()));
  fmt::print("{}, {}\n", readme.string(), kept.string());
}

int run(const ChartOptions& o) {
  if (o.from.empty()) fuzz::make_directory(o.out);  // before half an hour of work for it
  const fuzz::Chart chart = o.from.empty() ? measured(o) : stored(o.from);
  if (o.from.empty())
    write_result("chart", o.out, fuzz::to_json(chart).dump(), fuzz::to_csv(chart), reports::chart_text(chart),
                 o.json);
  else
    fmt::print("{}", o.json ? fuzz::to_json(chart).dump() + "\n" : reports::chart_text(chart));
  if (!o.readme.empty()) write_readme(o.readme, chart);
  for (const fuzz::ChartRow& r : chart.rows)
    if (r.engine == o.subject && r.wrong + r.failed > 0) return exit_wrong;
  return exit_clean;
}

}  // namespace

Run declare_chart(CLI::App& app) {
  auto o = std::make_shared<ChartOptions>();
  app.add_flag("--quick", o->quick, "fewer cases: minutes instead of half an hour");
  app.add_option("--engines", o->engines, "engines for pairs and motions: names, plug-in paths, or all")
      ->capture_default_str();
  app.add_option("--broad", o->broad, "broad phases, as for certify --subject, or all")
      ->capture_default_str();
  app.add_option("--subject", o->subject, "the engine whose faults decide the exit code")
      ->capture_default_str();
  app.add_option("--seed", o->seed, "same seed, same cases and errors")->capture_default_str();
  app.add_option("--measure", o->measure, "ns that each question about a pair is asked again for, to time it")
      ->check(CLI::Range(0, 100'000'000))
      ->capture_default_str();
  app.add_option("--out", o->out, "directory of chart.json, chart.csv, chart.html")->capture_default_str();
  add_case_seconds(app, o->limits);
  app.add_option("--from", o->from, "a chart.json to print instead of measuring one");
  app.add_option("--readme", o->readme,
                 "also renew the block of the chart in this file, and docs/chart.json beside it");
  app.add_flag("--json", o->json, "the whole result as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
