#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <set>

#include "cli/campaign_end.h"
#include "cli/causes_of_campaign.h"
#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/judged_by.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/shard.h"
#include "reports/text/text.h"
#include "scenarios/random/family.h"

namespace touchstone::cli {
namespace {

struct FuzzOptions {
  fuzz::CampaignConfig config;
  EngineChoice choice;
  std::string shard, out;
  std::uint64_t cases = 0;
  double minutes = 0;
  bool json = false, verbose = false;
  WorkerLimits limits;
};

void take_shard(const std::string& text, fuzz::CampaignConfig& c) {
  const fuzz::Shard s = fuzz::which_shard(text, [](const char* name) -> std::optional<std::string> {
    const char* v = std::getenv(name);
    return v ? std::optional<std::string>(v) : std::nullopt;
  });
  c.shard = s.index;
  c.shards = s.count;
  if (s.count > 1) fmt::print(stderr, "shard {} of {}, by {}\n", s.index, s.count, s.source);
}

std::string default_out() {
  char stamp[32];
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", &utc);
  return fmt::format("out/fuzz-{}-{}", stamp, getpid());
}

std::string progress_line(const fuzz::Progress& p, const fuzz::CampaignConfig& c) {
  std::map<std::string, std::size_t> by_engine;
  for (const auto& [key, f] : p.result.findings) ++by_engine[f.engine];
  std::vector<std::pair<std::size_t, std::string>> top;
  for (const auto& [e, n] : by_engine) top.emplace_back(n, e);
  std::sort(top.rbegin(), top.rend());
  std::string s = fmt::format("{} cases  {:.0f}/s", reports::grouped(p.result.cases), p.cases_per_s);
  if (p.left_s) s += "  " + reports::clock_text(*p.left_s) + " left";
  s += fmt::format("  {}: {} wrong{}", c.subject, p.result.wrong_of(c.subject),
                   top.empty() ? "" : "  findings:");
  for (std::size_t i = 0; i < top.size(); ++i) {
    const std::string item = fmt::format(" {} {}", top[i].second, top[i].first);
    if (s.size() + item.size() > 76) {
      s += " ...";
      break;
    }
    s += item;
  }
  return s;
}

// Updates one line on a terminal; prints a line every ten seconds otherwise.
class ProgressPrinter {
 public:
  explicit ProgressPrinter(const fuzz::CampaignConfig& c) : config_(c), live_(isatty(2) == 1) {}
  void operator()(const fuzz::Progress& p) {
    if (live_) {
      fmt::print(stderr, "\r\033[K{}{}", progress_line(p, config_), p.last ? "\n" : "");
    } else if (p.last || p.elapsed_s >= next_) {
      fmt::print(stderr, "{}\n", progress_line(p, config_));
      next_ = p.elapsed_s + 10;
    }
    std::fflush(stderr);
  }

 private:
  const fuzz::CampaignConfig& config_;
  bool live_;
  double next_ = 10;
};

int run(FuzzOptions& o) {
  take_shard(o.shard, o.config);
  const ChosenEngines chosen = chosen_engines(o.choice, o.limits);
  o.config.engines = chosen.names;
  o.config.subject = chosen.subject;
  o.config.kinds = chosen.shapes;
  if (!o.config.error.empty()) length_from_text(o.config.error);  // refuses a bad length at once
  if (o.cases > 0) o.config.cases = o.cases;
  if (o.minutes > 0) o.config.minutes = o.minutes;
  if (!o.config.cases && !o.config.minutes) o.config.minutes = 1;
  if (!o.config.family.empty()) fuzz::make_case(1, 0, o.config.family);  // refuses an unknown family at once
  o.config.out = o.out.empty() ? default_out() : o.out;
  o.limits.stop = &interrupted;
  const auto make_all = [&] { return judged_by(make_engines(o.config.engines, o.limits), o.config.error); };
  catch_stop_signals();
  const auto result = fuzz::run_campaign(o.config, make_all, ProgressPrinter(o.config), interrupted);
  std::string foreign;
  for (const std::string& name : o.config.engines)
    if (is_foreign(name)) foreign += (foreign.empty() ? "" : ",") + name;
  const CampaignEnd end{result, o.config.subject, o.config.family, o.config.out, foreign};
  if (o.json) {
    fmt::print("{}\n", campaign_json(end).dump(1));
  } else {
    const fuzz::Causes causes = known_causes("", result);
    print_campaign(end, {.finished = !interrupted, .verbose = o.verbose, .causes = &causes});
  }
  if (!interrupted) return campaign_verdict(end, o.json);
  return print_verdict(exit_failed, end.subject,
                       fmt::format("interrupted; resume with the same command and --out {}; so far {}",
                                   shell_word(end.out.string()), counts_of_subject(end)),
                       o.json);
}

}  // namespace

Run declare_fuzz(CLI::App& app) {
  auto o = std::make_shared<FuzzOptions>();
  add_engine_choice(app, o->choice);
  app.add_option("--family", o->config.family,
                 "only these families of cases: a,b,… (see `touchstone families`)");
  app.add_option("--seed", o->config.seed, "same seed and flags, same findings")->capture_default_str();
  app.add_option("--cases", o->cases, "stop after this many cases")->check(a_count());
  app.add_option("--minutes", o->minutes, "stop after this time (default 1 when --cases is not given)")
      ->check(a_positive_number());
  add_jobs(app, o->config.jobs);
  app.add_option("--shard", o->shard,
                 "i/n: run only shard i of n, counted from 0 (default: SLURM_ARRAY_TASK_ID of "
                 "SLURM_ARRAY_TASK_COUNT, or JOB_COMPLETION_INDEX of JOB_COMPLETIONS, if set)");
  app.add_flag("--guided", o->config.guided,
               "derive half of the cases from earlier ones that made an engine do something new");
  app.add_option("--relations", o->config.relations_every,
                 "also ask every N-th case in other forms (swapped, scaled, moved, ...); 0: never")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  app.add_option("-o,--out", o->out, "output directory; an unfinished campaign in it is resumed");
  app.add_flag("--fresh", o->config.fresh,
               "first move a campaign that is already in --out to the first free name of OUT.1, OUT.2, …");
  app.add_flag("--keep-answers", o->config.keep_answers,
               "also keep every case and answer in OUT/answers.bin, for `touchstone judge`: 0.9 kB a "
               "case for the core alone, 3 kB with FCL, Bullet, ODE and libccd");
  app.add_flag(
      "--certificates", o->config.certificates,
      "make the certificate of every finding at once (otherwise `touchstone check FINDING` makes it); "
      "with all engines this doubles the time a case takes");
  add_error(app, o->config.error);
  add_case_seconds(app, o->limits);
  add_verbose(app, o->verbose);
  app.add_flag("--json", o->json, "the whole result as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
