#include <fmt/format.h>
#include <unistd.h>

#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/output.h"
#include "fuzz/campaign/store.h"
#include "reports/stability/stability.h"
#include "reports/text/record_text.h"

namespace touchstone::cli {
namespace {

// CPU seconds a query, for small scenes: an engine that hangs does so on many rungs of a ladder.
constexpr double query_cpu_seconds = 0.2;

struct StabilityOptions {
  EngineChoice choice;
  std::string ladder, out = "out/stability";
  std::uint64_t seed = 1;
  bool quick = false, json = false;
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

int run(const StabilityOptions& o) {
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
  add_engine_choice(app, o->choice);
  app.add_option("--seed", o->seed, "same seed, same result")->capture_default_str();
  app.add_option("--out", o->out, "directory for stability.json, stability.csv, stability.html")
      ->capture_default_str();
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "the whole result as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
