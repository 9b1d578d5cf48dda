#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/import_options.h"
#include "cli/mcap_trajectory.h"
#include "cli/output.h"
#include "cli/page_contents.h"
#include "cli/progress_line.h"
#include "core/base/input_error.h"
#include "reports/assess/assess.h"
#include "reports/text/record_text.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

struct AssessArguments {
  std::string robot, world, out, page;
  ImportOptions import;
  fuzz::AssessOptions how;
  EngineChoice choice;
  WorkerLimits limits;
  bool json = false;
};

ImportedModel robot_and_world(const AssessArguments& o) {
  ImportedModel robot = import_model(o.robot, with_trajectory_text(o.import));
  print_import_notes(o.robot, robot);
  if (o.world.empty()) return robot;
  ImportOptions of_world;
  of_world.package_paths = o.import.package_paths;
  of_world.lenient = o.import.lenient;
  of_world.convex_meshes = o.import.convex_meshes;
  const ImportedModel world = import_model(o.world, of_world);
  print_import_notes(o.world, world);
  add_world(robot, world);
  return robot;
}

// The worst configuration as a case with its wrong pairs; without wrong answers, the first configuration.
StoredCase worst_case(const ImportedModel& robot, const std::vector<Configuration>& all,
                      const fuzz::Assessment& a, std::uint64_t seed) {
  constexpr std::size_t most_pairs = 6;
  const std::uint64_t number = a.worst_configuration.value_or(0);
  StoredCase s;
  s.c.scene = scene_of(robot.model, std::span(&all[number], 1));
  s.c.id = fmt::format("{}, configuration {}", s.c.scene.name, number);
  s.source = "assess, seed " + std::to_string(seed);
  for (const auto& [x, y] : a.worst_pairs) {
    if (s.c.queries.size() == 3 * most_pairs) break;
    for (const Question q : {Question::overlap, Question::distance, Question::contact})
      s.c.queries.push_back({q, x, y});
  }
  if (s.c.queries.empty()) s.c.queries = default_queries(s.c.scene);
  return s;
}

int write_assessment_page(const AssessArguments& o, const ImportedModel& robot, const fuzz::Assessment& a,
                          const std::vector<std::string>& engines) {
  const auto file = std::filesystem::path(o.page).replace_extension(".case.json");
  const std::vector<Configuration> all = fuzz::asked_configurations(robot, o.how);
  save_case(worst_case(robot, all, a, o.how.seed), file);
  const fuzz::Json page = assess_page(robot.model, all, a, make_engines(engines, o.limits),
                                      program_name() + " replay " + shell_word(file.string()));
  if (!write_page("assess", page.dump(), o.page)) return exit_failed;
  fmt::print(stderr,
             "{}: open it in a browser; {}: the configuration with the most wrong answers, as a case\n",
             printable(o.page), printable(file.string()));
  return exit_clean;
}

int verdict_on(const fuzz::Assessment& a, const std::string& subject, bool json) {
  const auto e = std::find_if(a.engines.begin(), a.engines.end(),
                              [&](const fuzz::AssessedEngine& x) { return x.name == subject; });
  std::uint64_t wrong = 0, failed = 0, answered = 0;
  if (e != a.engines.end())
    for (const auto& [question, tally] : e->tallies) {
      wrong += tally.wrong;
      failed += tally.failed();
      answered += tally.answered();
    }
  if (wrong + failed > 0)
    return print_verdict(
        exit_wrong, subject,
        fmt::format("wrong in {}{} of {} answers", wrong,
                    failed > 0 ? fmt::format(" and failed in {}", failed) : "", answered + failed),
        json);
  if (answered == 0)
    return print_verdict(exit_failed, subject, "it answered nothing; this run proves nothing", json);
  return print_verdict(a.interrupted ? exit_failed : exit_clean, subject,
                       fmt::format("0 wrong in {} answers{}", answered, a.interrupted ? "; interrupted" : ""),
                       json);
}

int run(AssessArguments o) {
  prepare_output(o.out);
  prepare_output(o.page);
  catch_stop_signals();
  o.limits.stop = &interrupted;
  const ImportedModel robot = robot_and_world(o);
  const auto kept = fuzz::joints_not_drawn(robot.model);
  if (robot.configurations.size() == 1 && !kept.empty())
    fmt::print(stderr, "touchstone: {} kept at the given value: no limits, or several variables\n",
               printable(fmt::format("{}", fmt::join(kept, ", "))));
  const ChosenEngines chosen = chosen_engines(o.choice, o.limits);
  ProgressLine progress;
  fuzz::Assessment a = fuzz::assess(
      robot, o.how, [&] { return make_engines(chosen.names, o.limits); },
      [&](std::string_view what, std::uint64_t done, std::uint64_t of) { progress.show(what, done, of); },
      interrupted);
  progress.clear();
  for (fuzz::AssessedEngine& e : a.engines) e.is_own = is_core_engine(e.name);
  a.world = o.world.empty() ? "" : std::filesystem::path(o.world).filename().string();
  if (o.json)
    fmt::print("{}\n", fuzz::to_json(a, true).dump(1));
  else
    fmt::print("{}", reports::assessment_text(a));
  if (!o.out.empty()) write_file(o.out, fuzz::to_json(a, true).dump(1) + "\n");
  if (!o.page.empty() && !a.interrupted)
    if (const int code = write_assessment_page(o, robot, a, chosen.names); code != exit_clean) return code;
  return verdict_on(a, chosen.subject, o.json);
}

}  // namespace

Run declare_assess(CLI::App& app) {
  auto o = std::make_shared<AssessArguments>();
  app.add_option("robot", o->robot, "robot: " + importable_endings())->required();
  app.add_option("--world", o->world, "what stands around it, fixed: a file of the same kinds");
  add_import_options(app, o->import);
  app.add_option("--samples", o->how.samples, "number of random configurations, if there is no trajectory")
      ->check(a_count())
      ->capture_default_str();
  app.add_option("--near", o->how.near, "pairs whose boxes are at most this far apart are asked, in metres")
      ->check(a_positive_number())
      ->capture_default_str();
  app.add_option("--error", o->how.error,
                 "the advice takes the fastest engine whose distances are off by at most this, in metres")
      ->check(a_positive_number())
      ->capture_default_str();
  app.add_option("--pairs", o->how.most_pairs, "largest number of pairs asked; they are spread evenly")
      ->check(a_count())
      ->capture_default_str();
  add_engine_choice(app, o->choice);
  app.add_option("--seed", o->how.seed, "same seed, same configurations and answers")->capture_default_str();
  add_jobs(app, o->how.jobs);
  app.add_option("-o,--out", o->out, "file for the whole result (JSON)");
  app.add_option(
      "--page", o->page,
      "file for a page with the pairs that engines get wrong on the robot in 3-D, and beside it the "
      "configuration with the most of them as a case");
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "the whole result as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
