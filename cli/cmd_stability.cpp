#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "cli/case_argument.h"
#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/store.h"
#include "oracles/client/remote_engine.h"
#include "reports/stability/motions.h"
#include "reports/stability/stability.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/random/motions.h"

namespace touchstone::cli {
namespace {

// CPU seconds a query, for small scenes: an engine that hangs does so on many rungs of a ladder.
constexpr double query_cpu_seconds = 0.2;

struct StabilityOptions {
  EngineChoice choice;
  std::string ladder, out = "out/stability";
  std::uint64_t seed = 1;
  bool quick = false, json = false, motions = false;
  std::string motion;
  int count = 0, frames = 32;
  WorkerLimits limits{.query_cpu_seconds = query_cpu_seconds, .patience = 1};
};

int verdict(const fuzz::Stability& s, const std::string& subject, bool json) {
  std::size_t ladders = 0, fallen = 0;
  std::uint64_t answers = 0;
  for (const fuzz::LadderResult& r : s.results) {
    if (r.engine != subject) continue;
    ++ladders;
    fallen += r.fails_at().has_value();
    for (const fuzz::Rung& rung : r.rungs) answers += rung.answers;
  }
  if (fallen > 0)
    return print_verdict(exit_wrong, subject, fmt::format("it fails on {} of {} ladders", fallen, ladders),
                         json);
  if (answers == 0)
    return print_verdict(exit_failed, subject, "it answered nothing; this run proves nothing", json);
  return print_verdict(exit_clean, subject, fmt::format("it fails on none of {} ladders", ladders), json);
}

// Motions.

constexpr int quick_count = 4, full_count = 24;  // motions a row

bool forget(Engine& e) {
  auto* const remote = dynamic_cast<RemoteEngine*>(&e);
  if (!remote) return false;
  remote->suspend("to forget what it was asked");
  remote->resume();
  return true;
}

int verdict_on_motions(const fuzz::Motions& m, const std::string& subject, bool json) {
  fuzz::MotionResult sum;
  for (const fuzz::MotionResult& r : m.results)
    if (r.engine == subject) sum.merge(r);
  const std::string flicker = fmt::format("{} flickers in {} changes", reports::grouped(sum.flicker_sum()),
                                          reports::grouped(sum.changes));
  if (sum.wrong + sum.failed + sum.state_differs > 0)
    return print_verdict(
        exit_wrong, subject,
        fmt::format("{} wrong, {} failed, {} that depend on earlier frames in {} answers; {}",
                    reports::grouped(sum.wrong), reports::grouped(sum.failed),
                    reports::grouped(sum.state_differs), reports::grouped(sum.answers + sum.failed), flicker),
        json);
  if (sum.answers == 0)
    return print_verdict(exit_failed, subject, "it answered nothing; this run proves nothing", json);
  return print_verdict(exit_clean, subject,
                       fmt::format("0 wrong in {} answers, 0 of {} depend on earlier frames; {}",
                                   reports::grouped(sum.answers), reports::grouped(sum.state_asked), flicker),
                       json);
}

// The motion of a case: a script with at least two queries, and questions about pairs.
fuzz::Motions follow_case(const std::string& name, std::span<const EnginePtr> engines) {
  const Case c = case_argument(name).c;
  const auto queries = std::count_if(c.scene.script.begin(), c.scene.script.end(),
                                     [](const Step& s) { return s.op == Step::Op::query; });
  if (queries < 2) throw InputError(name, "is no motion: its script has fewer than two queries");
  fuzz::Motions m;
  m.count = 1;
  m.frames = static_cast<int>(queries);
  m.results = fuzz::follow(c, engines, forget, true);
  for (fuzz::MotionResult& r : m.results) r.motion = "motion";
  m.rows = {{"motion", c.id}};
  return m;
}

void write_motions(const fuzz::Motions& m, const std::string& file, bool as_json) {
  const std::string json = fuzz::to_json(m).dump();
  write_file(file + ".json", json);
  write_file(file + ".csv", fuzz::to_csv(m));
  if (!m.cases.empty()) fuzz::make_directory(file);
  for (const Case& c : m.cases) {
    std::string name = c.id;
    std::replace(name.begin(), name.end(), '/', '-');
    save_case({c, "", "touchstone stability --motions", {}}, fmt::format("{}/{}.json", file, name));
  }
  fmt::print("{}\n", as_json ? json : reports::motions_text(m));
  std::FILE* const to = as_json ? stderr : stdout;
  fmt::print(to, "{0}.json, {0}.csv\n", file);
  if (!m.cases.empty())
    fmt::print(to,
               "{0}/*.json: the motions named above\n"
               "  touchstone stability --motion FILE   follows one again\n"
               "  touchstone replay FILE               asks one of its frames alone\n",
               file);
}

bool is_motion_row(const std::string& name) {
  const auto rows = fuzz::motion_rows();
  return std::any_of(rows.begin(), rows.end(), [&](const fuzz::MotionRow& r) { return r.name == name; });
}

int run_motions(const StabilityOptions& o) {
  const bool live = isatty(2) == 1;
  const ChosenEngines chosen = chosen_engines(o.choice, o.limits);
  fuzz::make_directory(o.out);
  const std::vector<EnginePtr> engines = make_engines(chosen.names, o.limits);
  fuzz::MotionPlan plan{o.motion, o.seed, o.count, o.frames};
  if (plan.count == 0) plan.count = o.quick ? quick_count : full_count;
  const bool of_case = !o.motion.empty() && !is_motion_row(o.motion);
  const fuzz::Motions m = of_case ? follow_case(o.motion, engines)
                                  : fuzz::follow_all(plan, engines, forget, [live](const std::string& what) {
                                      if (live) fmt::print(stderr, "\r\033[K{}", what);
                                    });
  if (live) fmt::print(stderr, "\r\033[K");
  write_motions(m, fmt::format("{}/motions", o.out), o.json);
  return verdict_on_motions(m, chosen.subject, o.json);
}

int run(const StabilityOptions& o) {
  if (o.motions || !o.motion.empty()) return run_motions(o);
  const bool live = isatty(2) == 1;
  const ChosenEngines chosen = chosen_engines(o.choice, o.limits);
  fuzz::make_directory(o.out);  // fails before half an hour of work, not after it
  const std::vector<EnginePtr> engines = make_engines(chosen.names, o.limits);
  fuzz::Stability s =
      fuzz::climb(o.ladder, o.seed, o.quick ? 12 : 100, engines, [live](const std::string& what) {
        if (live) fmt::print(stderr, "\r\033[K{}", what);
      });
  if (live) fmt::print(stderr, "\r\033[K");
  s.scope = o.quick ? "quick" : "full";
  write_result("stability", o.out, fuzz::to_json(s).dump(), fuzz::to_csv(s), reports::stability_text(s),
               o.json);
  return verdict(s, chosen.subject, o.json);
}

}  // namespace

Run declare_stability(CLI::App& app) {
  auto o = std::make_shared<StabilityOptions>();
  app.add_flag("--quick", o->quick, "a dozen cases per rung instead of a hundred");
  app.add_option("--ladder", o->ladder, "only this ladder (default: all)");
  app.add_flag("--motions", o->motions,
               "instead of ladders: smooth motions in frames; what changes from frame to frame though the "
               "truth does not");
  app.add_option("--motion", o->motion,
                 "only this motion: settle, slide, roll, top, hinge, pass, or a case with a script");
  app.add_option("--frames", o->frames, "frames of a motion")
      ->check(CLI::Range(2, 100'000))
      ->capture_default_str();
  app.add_option("--count", o->count, "motions of each kind (default: 24, with --quick 4)")
      ->check(CLI::Range(1, 1'000'000));
  add_engine_choice(app, o->choice);
  app.add_option("--seed", o->seed, "same seed, same result")->capture_default_str();
  app.add_option(
         "-o,--out", o->out,
         "directory for stability.json, stability.csv, stability.html, or motions.json and motions.csv")
      ->capture_default_str();
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "the whole result as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
