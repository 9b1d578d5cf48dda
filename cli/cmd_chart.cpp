#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/output.h"
#include "fuzz/campaign/store.h"
#include "oracles/abi/measure.h"
#include "oracles/core/core_engine.h"
#include "reports/chart/chart.h"
#include "reports/chart/sub_steps.h"
#include "reports/text/record_text.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

struct ChartOptions {
  EngineChoice choice;
  std::string broad = "all", out = "out/chart", from, document;
  std::uint64_t seed = 1;
  std::int64_t measure = 20'000;
  bool quick = false, json = false;
  WorkerLimits limits{.patience = 1};
};

// Thousands of bodies are one question.
constexpr double crowd_cpu_seconds = 10;

std::vector<EnginePtr> broad_engines(const ChartOptions& o) {
  WorkerLimits limits = o.limits;
  limits.query_cpu_seconds = std::max(limits.query_cpu_seconds, crowd_cpu_seconds);
  std::vector<std::string> names;
  if (o.broad == "all") {
    for (std::string_view name : core_broad_phases()) names.emplace_back(name);
    for (std::string& name : present_engines(EngineKind::broad)) names.push_back(std::move(name));
  } else if (!o.broad.empty()) {
    for_each_in_list(o.broad, [&](std::string_view name) { names.emplace_back(name); });
  }
  std::vector<EnginePtr> engines;
  for (const auto& name : names)
    engines.push_back(broad_subject(name, limits, false).make(BroadLevel::bodies));
  return engines;
}

// The engines named. For "all", other settings and sub-stepping are added.
std::vector<EnginePtr> pair_engines(const ChartOptions& o, std::vector<std::string> names) {
  const bool all = o.choice.engines == "all";
  // core-kept builds per question what a program builds once, so its times mean nothing here.
  if (all) std::erase(names, "core-kept");
  std::vector<EnginePtr> engines = make_engines(names, o.limits);
  if (!all) return engines;
  for (const std::string& name : present_engines(EngineKind::settings))
    engines.push_back(make_engine(name, o.limits));
  const auto stepped = stepped_engines();
  for (const std::string& name : present_engines(EngineKind::pairs)) {
    if (std::find(stepped.begin(), stepped.end(), name) == stepped.end()) continue;
    const std::shared_ptr<Engine> inner = make_engine(name, o.limits);
    for (const int steps : step_counts) engines.push_back(fuzz::sub_stepped(inner, steps));
  }
  return engines;
}

// A broad phase may also be the subject, under the chart's name for it.
struct ChartEngines {
  std::vector<EnginePtr> pairs, broad;
  std::string subject;
};

ChartEngines chart_engines(const ChartOptions& o) {
  ChartEngines r;
  r.broad = broad_engines(o);
  const bool is_broad = std::any_of(r.broad.begin(), r.broad.end(),
                                    [&](const EnginePtr& e) { return e->card().name == o.choice.subject; });
  EngineChoice choice = o.choice;
  if (is_broad) choice.subject = engine_names(o.choice.engines)[0];  // any engine that is queried anyway
  const ChosenEngines chosen = chosen_engines(choice, o.limits);
  r.pairs = pair_engines(o, chosen.names);
  r.subject = is_broad ? o.choice.subject : chosen.subject;
  return r;
}

fuzz::Chart measured(const ChartOptions& o, std::string& subject) {
  const bool live = isatty(2) == 1;
  // Set before any engine is made, because its worker inherits it.
  setenv(measure_variable, std::to_string(o.measure).c_str(), 1);
  const ChartEngines chosen = chart_engines(o);
  subject = chosen.subject;
  fuzz::Chart chart = fuzz::measure_chart(o.quick ? fuzz::quick_chart() : fuzz::full_chart(), o.seed,
                                          chosen.pairs, chosen.broad, [live](const std::string& what) {
                                            if (live) fmt::print(stderr, "\r\033[K{}", what);
                                          });
  if (live) fmt::print(stderr, "\r\033[K");
  return chart;
}

fuzz::Chart stored(const std::string& file) {
  const auto j = load_json(file);
  return fuzz::chart_from_json(j, file);
}

// The numbers and the picture, for a light and a dark page, are stored beside the document, so that a test
// can compare them. All are made from the stored numbers, which have fewer digits than the measured ones.
void update_document(const std::filesystem::path& document, const fuzz::Chart& chart) {
  const std::string before = read_file(document, std::uintmax_t{1} << 24);
  const auto kept = document.parent_path() / "chart.json";
  write_file(kept, fuzz::to_json(reports::chart_excerpt(chart)).dump() + "\n");
  const fuzz::Chart excerpt = stored(kept.string());
  write_file(document,
             reports::with_chart_block(before, reports::chart_markdown(excerpt), document.string()));
  for (const bool dark : {false, true})
    write_file(document.parent_path() / (dark ? "chart-dark.svg" : "chart-light.svg"),
               reports::chart_svg(excerpt, dark));
  fmt::print("{}, {} and its picture\n", document.string(), kept.string());
}

// The subject of a stored chart: one of the engines in its rows.
std::string subject_of(const fuzz::Chart& chart, const std::string& given) {
  std::vector<std::string> known;
  for (const fuzz::ChartRow& r : chart.rows)
    if (std::find(known.begin(), known.end(), r.engine) == known.end()) known.push_back(r.engine);
  const std::string subject = given.empty() && known.size() == 1 ? known[0] : given.empty() ? "core" : given;
  require_subject(subject, known, "the chart's engines");
  return subject;
}

int verdict(const fuzz::Chart& chart, const std::string& subject, bool json) {
  std::uint64_t asked = 0, wrong = 0, failed = 0, answers = 0;
  for (const fuzz::ChartRow& r : chart.rows) {
    const bool whole =
        r.regime.empty() && r.pair.empty() && r.scale.empty();  // the others are parts of these
    if (r.engine != subject || !whole) continue;
    asked += r.asked;
    wrong += r.wrong;
    failed += r.failed;
    answers += r.answers;
  }
  if (wrong + failed > 0)
    return print_verdict(exit_wrong, subject,
                         fmt::format("wrong in {} and failed in {} of {} queries", wrong, failed, asked),
                         json);
  if (answers == 0)
    return print_verdict(exit_failed, subject, "it answered nothing; this run proves nothing", json);
  return print_verdict(exit_clean, subject, fmt::format("0 wrong in {} queries", asked), json);
}

int run(ChartOptions o) {
  // An engine of the document's table that is absent is an error: the table would lose its row.
  if (!o.document.empty() && o.from.empty() && o.choice.engines == "all")
    o.choice.engines = fmt::format("{}", fmt::join(reports::engines_of_excerpt(), ","));
  if (o.from.empty()) fuzz::make_directory(o.out);  // fails before half an hour of work, not after it
  std::string subject;
  const fuzz::Chart chart = o.from.empty() ? measured(o, subject) : stored(o.from);
  if (!o.from.empty()) subject = subject_of(chart, o.choice.subject);
  if (o.from.empty())
    write_result("chart", o.out, fuzz::to_json(chart).dump(), fuzz::to_csv(chart), reports::chart_text(chart),
                 o.json);
  else
    fmt::print("{}", o.json ? fuzz::to_json(chart).dump() + "\n" : reports::chart_text(chart));
  if (!o.document.empty()) update_document(o.document, chart);
  return verdict(chart, subject, o.json);
}

}  // namespace

Run declare_chart(CLI::App& app) {
  auto o = std::make_shared<ChartOptions>();
  app.add_flag("--quick", o->quick, "fewer cases: takes minutes instead of half an hour");
  add_engine_choice(app, o->choice);
  app.add_option("--broad", o->broad, "broad phases, as for certify --subject, or all")
      ->capture_default_str();
  app.add_option("--seed", o->seed, "same seed, same cases and errors")->capture_default_str();
  app.add_option("--measure", o->measure, "ns for which each pair query is repeated to time it")
      ->check(CLI::Range(0, 100'000'000))
      ->capture_default_str();
  app.add_option("-o,--out", o->out, "directory for chart.json, chart.csv, chart.html")
      ->capture_default_str();
  add_case_seconds(app, o->limits);
  app.add_option("--from", o->from, "a chart.json to print instead of measuring one");
  app.add_option("--update", o->document,
                 "also update the chart block in this file, and chart.json and the pictures beside it; "
                 "unless --engines says otherwise, the engines of that block are queried");
  app.add_flag("--json", o->json, "the whole result as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
