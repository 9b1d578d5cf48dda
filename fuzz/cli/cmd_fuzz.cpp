#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <set>
#include <thread>

#include "core/base/input_error.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/shard.h"
#include "fuzz/cli/command.h"
#include "fuzz/cli/engine_catalog.h"
#include "fuzz/generate/family.h"
#include "reports/text.h"

namespace touchstone::cli {
namespace {

std::atomic<bool> interrupted{false};

void on_signal(int) { interrupted = true; }

struct FuzzOptions {
  fuzz::CampaignConfig config;
  std::string engines = "all", shard, out;
  std::uint64_t cases = 0;
  double minutes = 0;
  bool json = false;
  WorkerLimits limits;
};

void take_shard(const std::string& text, fuzz::CampaignConfig& c) {
  const fuzz::Shard s = fuzz::which_shard(text, [](const char* name) -> std::optional<std::string> {
    const char* v = std::getenv(name);
    return v ? std::optional<std::string>(v) : std::nullopt;
  });
  c.shard = s.index, c.shards = s.count;
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
  s += fmt::format("  {}: {} wrong  findings:", c.subject, p.result.wrong_of(c.subject));
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

// A live line on a terminal, a plain line every ten seconds otherwise.
class ProgressPrinter {
 public:
  explicit ProgressPrinter(const fuzz::CampaignConfig& c) : config_(c), live_(isatty(2) == 1) {}
  void operator()(const fuzz::Progress& p) {
    if (live_)
      fmt::print(stderr, "\r\033[K{}{}", progress_line(p, config_), p.last ? "\n" : "");
    else if (p.last || p.elapsed_s >= next_)
      fmt::print(stderr, "{}\n", progress_line(p, config_)), next_ = p.elapsed_s + 10;
    std::fflush(stderr);
  }

 private:
  const fuzz::CampaignConfig& config_;
  bool live_;
  double next_ = 10;
};

void print_text(const fuzz::CampaignConfig& c, const fuzz::CampaignResult& r) {
  fmt::print("{}\n", reports::campaign_table(r));
  if (!r.findings.empty())
    fmt::print("Findings by engine, the three most frequent kinds of each:\n{}\n",
               reports::findings_summary(r, 3));
  fmt::print("{}", reports::campaign_footer(r));
  if (r.findings.empty())
    return fmt::print("no findings; the counts are in {}/summary.json\n", c.out.string());
  fmt::print(
      "{} kinds of findings in {}/findings; look at one with\n  ./touchstone replay "
      "{}/findings/{}/case.json\n",
      reports::grouped(r.findings.size()), c.out.string(), c.out.string(), r.findings.begin()->first);
}

int verdict(const fuzz::CampaignConfig& c, const fuzz::CampaignResult& r, bool json) {
  const auto say = [&](const std::string& text) { fmt::print(json ? stderr : stdout, "{}\n", text); };
  const auto wrong = r.wrong_of(c.subject), failed = r.failed_of(c.subject);
  std::uint64_t answers = 0;
  if (const auto it = r.tallies.find(c.subject); it != r.tallies.end())
    for (const auto& [q, t] : it->second) answers += t.answered();
  if (interrupted) {
    say(fmt::format("interrupted; go on with the same command and --out {}", c.out.string()));
    return exit_failed;
  }
  if (wrong + failed > 0) {
    say(fmt::format("{}: WRONG in {} and failed in {} of {} answers", c.subject, reports::grouped(wrong),
                    reports::grouped(failed), reports::grouped(answers + failed)));
    return exit_wrong;
  }
  if (answers == 0) {
    say(fmt::format("{}: answered nothing; this run proves nothing", c.subject));
    return exit_failed;
  }
  // A campaign whose pairs nearly all overlap, or nearly none, tests half of what it says.
  if (c.family.empty() && r.pair_cases >= 200 && (r.hit_rate() < 0.3 || r.hit_rate() > 0.7)) {
    say(fmt::format("{:.0f} % of the pairs overlap, outside 30-70 %: this run proves nothing",
                    100 * r.hit_rate()));
    return exit_failed;
  }
  say(fmt::format("{}: 0 wrong in {} answers", c.subject, reports::grouped(answers)));
  return exit_clean;
}

int run(FuzzOptions& o) {
  take_shard(o.shard, o.config);
  o.config.engines = engine_names(o.engines);
  const auto subjects = engine_names(o.config.subject);
  if (subjects.size() != 1) throw InputError("--subject " + o.config.subject, "names more than one engine");
  if (std::find(o.config.engines.begin(), o.config.engines.end(), subjects[0]) == o.config.engines.end())
    o.config.engines.insert(o.config.engines.begin(), subjects[0]);
  if (o.cases > 0) o.config.cases = o.cases;
  if (o.minutes > 0) o.config.minutes = o.minutes;
  if (!o.config.cases && !o.config.minutes) o.config.minutes = 1;
  if (!o.config.family.empty()) fuzz::make_case(1, 0, o.config.family);  // refuses an unknown family at once
  o.config.out = o.out.empty() ? default_out() : o.out;
  const auto make_all = [&] {
    std::vector<EnginePtr> engines;
    for (const auto& name : o.config.engines) engines.push_back(make_engine(name, o.limits));
    return engines;
  };
  o.limits.stop = &interrupted;
  // The subject's own name, which for a plug-in is that of its card.
  o.config.subject = make_engine(subjects[0], o.limits)->card().name;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  const auto result = fuzz::run_campaign(o.config, make_all, ProgressPrinter(o.config), interrupted);
  if (o.json) {
    auto j = fuzz::to_json(result, true);
    j["digest"] = fuzz::digest(result), j["out"] = o.config.out.string();
    fmt::print("{}\n", j.dump(1));
  } else {
    print_text(o.config, result);
  }
  const int code = verdict(o.config, result, o.json);
  if (!o.json && !interrupted)
    fmt::print("All of it as a page: ./touchstone report {0} -o {0}/report.html\n", o.config.out.string());
  return code;
}

}  // namespace

Run declare_fuzz(CLI::App& app) {
  auto o = std::make_shared<FuzzOptions>();
  o->config.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  app.add_option("--subject", o->config.subject, "the engine whose faults decide the exit code")
      ->capture_default_str();
  app.add_option("--engines", o->engines, "engines to ask: names, plug-in paths, or all")
      ->capture_default_str();
  app.add_option("--family", o->config.family,
                 "only these families of cases: a,b,… (see `touchstone families`)");
  app.add_option("--seed", o->config.seed, "same seed and flags, same findings")->capture_default_str();
  app.add_option("--cases", o->cases, "stop after this many cases")->check(CLI::PositiveNumber);
  app.add_option("--minutes", o->minutes, "stop after this time (default 1 when --cases is not given)")
      ->check(CLI::PositiveNumber);
  app.add_option("--jobs", o->config.jobs, "jobs side by side")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option(
      "--shard", o->shard,
      "i/n: only the i-th of n parts of the campaign, i from 0 (default: SLURM_ARRAY_TASK_ID of _COUNT, or "
      "JOB_COMPLETION_INDEX of JOB_COMPLETIONS, if they are set)");
  app.add_flag("--guided", o->config.guided,
               "half of the cases are changed forms of those that made an engine do something new");
  app.add_option("--relations", o->config.relations_every,
                 "every so many cases one is also asked swapped, scaled, moved, ...; 0: none")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  app.add_option("--out", o->out, "directory of the results; an unfinished campaign in it is gone on with");
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "the whole result as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
