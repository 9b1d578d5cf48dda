#include <fmt/format.h>
#include <unistd.h>

#include "fuzz/campaign/store.h"
#include "fuzz/cli/command.h"
#include "fuzz/cli/engine_catalog.h"
#include "fuzz/cli/pages.h"
#include "fuzz/explore/stability.h"
#include "reports/stability_text.h"

namespace touchstone::cli {
namespace {

struct StabilityOptions {
  std::string engines = "all", ladder, subject = "core", out = "out/stability";
  std::uint64_t seed = 1;
  bool quick = false, json = false;
  WorkerLimits limits{.query_cpu_seconds = 0.2};
};

int run(const StabilityOptions& o) {
  const bool live = isatty(2) == 1;
  fuzz::make_directory(o.out);  // before half an hour of work for it
  std::vector<EnginePtr> engines;
  for (const auto& name : engine_names(o.engines)) engines.push_back(make_engine(name, o.limits));
  fuzz::Stability s =
      fuzz::climb(o.ladder, o.seed, o.quick ? 12 : 100, engines, [live](const std::string& what) {
        if (live) fmt::print(stderr, "\r\033[K{}", what);
      });
  if (live) fmt::print(stderr, "\r\033[K");
  s.scope = o.quick ? "quick" : "full";
  write_result("stability", o.out, fuzz::to_json(s).dump(), fuzz::to_csv(s), reports::stability_text(s),
               o.json);
  for (const fuzz::LadderResult& r : s.results)
    if (r.engine == o.subject && r.fails_at()) return exit_wrong;
  return exit_clean;
}

}  // namespace

Run declare_stability(CLI::App& app) {
  auto o = std::make_shared<StabilityOptions>();
  app.add_flag("--quick", o->quick, "a dozen cases a rung instead of a hundred");
  app.add_option("--ladder", o->ladder, "only this ladder (default: all)");
  app.add_option("--engines", o->engines, "engines to ask: names, plug-in paths, or all")
      ->capture_default_str();
  app.add_option("--subject", o->subject, "the engine whose faults decide the exit code")
      ->capture_default_str();
  app.add_option("--seed", o->seed, "same seed, same result")->capture_default_str();
  app.add_option("--out", o->out, "directory of stability.json, stability.csv, stability.html")
      ->capture_default_str();
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "the whole result as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
