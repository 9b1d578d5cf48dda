// touchstone judge DIR: judges a stored campaign again from the answers that it kept. No engine is started.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <vector>

#include "cli/campaign_end.h"
#include "cli/causes_of_campaign.h"
#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/judge_again.h"
#include "reports/text/junit.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

struct JudgeOptions {
  std::string directory, engine, out, junit;
  int jobs = 1;
  bool json = false, verbose = false;
};

// What needs an engine, and so was not judged again.
std::string describe_limits(const fuzz::JudgedAgain& j) {
  std::string s =
      "Carried over, since no engine was asked: times, which answers changed when asked again, the last "
      "words of dying engines, and which engines were set aside.";
  if (j.not_kept_derived > 0)
    s += fmt::format(" {} other forms of cases, which this version would ask about, were not judged.",
                     reports::grouped(j.not_kept_derived));
  if (j.not_kept_again > 0)
    s += fmt::format(
        " {} cases with an answer newly found wrong were never asked again, so that it may be an "
        "unstable one.",
        reports::grouped(j.not_kept_again));
  return reports::wrapped(s, 79, 2) + "\n";
}

bool are_stored(const fuzz::CampaignResult& before, const fuzz::CampaignResult& after) {
  return std::all_of(after.findings.begin(), after.findings.end(),
                     [&](const auto& f) { return before.findings.contains(f.first); });
}

// Every finding of either result, for JUnit: one that appeared is a failure.
std::vector<reports::JUnitTest> tests_of(const fuzz::CampaignResult& before,
                                         const fuzz::CampaignResult& after) {
  using reports::TestResult;
  std::vector<reports::JUnitTest> all;
  for (const auto& [key, f] : after.findings)
    if (before.findings.contains(key))
      all.push_back({f.engine, key, TestResult::skipped, "known since the stored result", ""});
    else
      all.push_back({f.engine, key, TestResult::failed, "new", f.words});
  for (const auto& [key, f] : before.findings)
    if (!after.findings.contains(key)) all.push_back({f.engine, key, TestResult::passed, "", ""});
  return all;
}

int run(const JudgeOptions& o) {
  prepare_output(o.junit);
  catch_stop_signals();
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds between_reports(10);
  auto reported = Clock::now();
  const auto progress = [&](std::uint64_t judged, std::uint64_t all) {
    if (Clock::now() - reported < between_reports) return;
    reported = Clock::now();
    fmt::print(stderr, "{} of {} cases judged\n", reports::grouped(judged), reports::grouped(all));
  };
  const fuzz::JudgedAgain judged = fuzz::judge_again(o.directory, o.engine, o.jobs, interrupted, progress);
  const JsonReader settings(judged.settings, (std::filesystem::path(o.directory) / "state.json").string(),
                            "settings");
  if (!o.out.empty()) fuzz::save_judged_again(o.out, judged);
  if (!o.junit.empty()) write_file(o.junit, reports::junit(tests_of(judged.before, judged.after)));
  CampaignEnd end{judged.after, o.engine.empty() ? settings["subject"].string() : o.engine,
                  settings["family"].string(), o.out};
  // The stored findings are what is there to look at, unless they are others now.
  if (o.out.empty() && are_stored(judged.before, judged.after)) end.out = o.directory;
  const fuzz::ResultChanges changes = fuzz::changes_between(judged.before, judged.after);
  if (o.json) {
    fuzz::Json j = campaign_json(end);
    j["changes"] = fuzz::to_json(changes);
    j["not_kept"] = {{"derived", judged.not_kept_derived}, {"again", judged.not_kept_again}};
    fmt::print("{}\n", json_text(j, 1));
  } else {
    const fuzz::Causes causes = known_causes(end.out.string(), judged.after);
    print_campaign(end, {.verbose = o.verbose, .causes = &causes});
    fmt::print("{}{}", reports::changes_text(changes), describe_limits(judged));
  }
  return campaign_verdict(end, o.json);
}

}  // namespace

Run declare_judge(CLI::App& app) {
  auto o = std::make_shared<JudgeOptions>();
  app.add_option("directory", o->directory, "directory of a campaign that was run with --keep-answers")
      ->required();
  app.add_option("--engine", o->engine, "judge this engine alone; it is then the subject");
  add_jobs(app, o->jobs);
  app.add_option("-o,--out", o->out,
                 "new directory for the findings as judged now, which `report` and `triage` accept");
  app.add_option("--junit", o->junit, "write the findings as JUnit XML to this file; new ones are failures");
  add_verbose(app, o->verbose);
  app.add_flag("--json", o->json, "the whole result and what changed as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
