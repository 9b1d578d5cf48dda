// touchstone triage DIR: compares the causes of a campaign with the ledger of known ones.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <filesystem>
#include <functional>
#include <set>

#include "cli/causes_of_campaign.h"
#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/date.h"
#include "cli/engines_by_card.h"
#include "cli/judged_by.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/store.h"
#include "fuzz/shrink/keeps_finding.h"
#include "fuzz/triage/cause_files.h"
#include "fuzz/triage/triage.h"
#include "reports/record/stored.h"
#include "reports/text/causes_text.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

struct TriageOptions {
  std::string directory, ledger = "causes.db", engines, subject = "all", junit, date, reproducers, error;
  std::string suppress, unsuppress, reason, until;
  bool json = false;
  int jobs = 1;
  WorkerLimits limits;
};

/// What triage takes from other commands.
struct TriageSources {
  std::function<fuzz::Causes()> causes;
  std::function<std::string(const fuzz::Cause&)> issue;  // its text for an issue tracker; empty: none
};

Foreign foreign_of(const TriageOptions& o) {
  std::vector<std::string> given;
  if (!o.engines.empty()) given = engine_names(o.engines);
  if (is_foreign(o.subject)) given.push_back(engine_name(o.subject));
  return foreign_engines(given, o.limits);
}

fuzz::TriageConfig config_of(const std::string& date, EnginesByCard& engines) {
  fuzz::TriageConfig c;
  c.date = date;
  c.build_of = [&](const std::string& engine) {
    const EnginePtr& e = engines.named(engine);
    return e ? e->card().library + " " + e->card().version : std::string();
  };
  c.ask = [&](const std::string& engine, const Case& asked) {
    return fuzz::findings_of({&asked, 1}, engines.named(engine), fuzz::FoundBy::both)[0];
  };
  return c;
}

// A directory that cannot be written does not affect the others.
void write_causes(const std::string& directory, const TriageSources& sources, const fuzz::Causes& causes) {
  std::size_t written = 0, before = 0, no_case = 0;
  std::vector<std::string> failed;
  for (const fuzz::Cause& c : causes.causes) try {
      const fuzz::Written w = fuzz::write_cause(directory, c, sources.issue);
      written += w == fuzz::Written::now;
      before += w == fuzz::Written::before;
      no_case += w == fuzz::Written::no_case;
    } catch (const std::exception& e) {
      failed.push_back(c.id + ": " + e.what());
    }
  std::string words =
      fmt::format("reproducers in {}: {} written, {} already there", directory, written, before);
  if (no_case > 0) words += fmt::format(", {} skipped because no case shows them", no_case);
  if (!failed.empty()) words += fmt::format(", {} failed", failed.size());
  if (written + before == 0) words += "; this run added nothing";
  fmt::print(stderr, "{}\n", words);
  for (const std::string& why : failed) fmt::print(stderr, "touchstone: no reproducer: {}\n", printable(why));
}

// Called before any work is done: a directory that cannot be created is bad usage.
void make_directory(const std::string& option, const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path))
    throw InputError(option, fmt::format("{}: cannot create this directory: {}", path,
                                         error ? error.message() : "it exists and is not a directory"));
}

// The engines that answered or failed in the campaign, from its summary.
std::set<std::string> answered_in(const std::string& directory) {
  fuzz::require_campaign(directory);
  const auto file = std::filesystem::path(directory) / "summary.json";
  const fuzz::Json j = load_json(file, campaign_limits);
  const fuzz::CampaignResult r = fuzz::result_from_json(JsonReader(j, file.string()));
  std::set<std::string> names;
  for (const auto& [engine, questions] : r.tallies)
    if (r.answered_by(engine) + r.failed_of(engine) > 0) names.insert(engine);
  return names;
}

// The subject's name in causes, or "all".
std::string resolved_subject(const TriageOptions& o, const Foreign& foreign,
                             const std::set<std::string>& answered,
                             const std::vector<fuzz::KnownCause>& known) {
  if (o.subject == "all") return o.subject;
  for (const auto& [card_name, name] : foreign)
    if (name == o.subject || card_name == o.subject) return card_name;
  if (is_catalogued(o.subject)) return o.subject;
  std::set<std::string> names = answered;
  for (const fuzz::KnownCause& k : known) names.insert(k.engines.begin(), k.engines.end());
  if (names.contains(o.subject)) return o.subject;
  std::vector<std::string> all = catalogued_names();
  all.insert(all.end(), names.begin(), names.end());
  throw InputError(
      "--subject " + o.subject,
      "this engine is in neither the campaign nor the ledger nor a catalogue" + did_you_mean(o.subject, all));
}

struct Verdict {
  std::string subject;
  bool answered = false;  // it answered something, in the campaign or now
  std::size_t fresh = 0, back = 0, ended = 0, troubled = 0;
};

Verdict verdict_on(const std::string& subject, const std::set<std::string>& answered,
                   const std::vector<fuzz::Triaged>& triaged) {
  Verdict v{subject == "all" ? "all engines" : subject};
  v.answered = subject == "all" ? !answered.empty() : answered.contains(subject);
  for (const fuzz::Triaged& t : triaged) {
    const auto& engines = t.cause.engines;
    if (subject != "all" && !std::binary_search(engines.begin(), engines.end(), subject)) continue;
    v.answered |= t.asked > 0;
    v.fresh += t.standing == fuzz::Standing::fresh;
    v.back += t.standing == fuzz::Standing::back;
    v.ended += t.suppression_ended && t.standing != fuzz::Standing::back;
    v.troubled += !t.trouble.empty();
  }
  return v;
}

int say(const Verdict& v, bool json) {
  if (v.fresh + v.back + v.ended > 0) {
    std::string words =
        fmt::format("{}, {} back", reports::counted(v.fresh, "new cause", "new causes"), v.back);
    if (v.ended > 0) words += fmt::format(", {} no longer suppressed", v.ended);
    return print_verdict(exit_wrong, v.subject, words, json);
  }
  if (v.troubled > 0)
    return print_verdict(exit_failed, v.subject,
                         reports::counted(v.troubled, "cause", "causes") + " could not be asked again", json);
  if (!v.answered)
    return print_verdict(exit_failed, v.subject, "it answered nothing; this campaign proves nothing", json);
  return print_verdict(exit_clean, v.subject, "no new causes", json);
}

void require_stdout_written() {
  if ((std::fflush(stdout) != 0 || std::ferror(stdout)) && errno != EPIPE)
    throw std::runtime_error(std::string("the output cannot be written: ") + std::strerror(errno));
}

int triage_campaign(const TriageOptions& o, const TriageSources& sources) {
  const std::string date = date_of_run(o.date);
  if (!o.reproducers.empty()) make_directory("--reproducers", o.reproducers);
  if (!o.error.empty()) length_from_text(o.error);  // refuses a bad length at once
  prepare_output(o.junit);
  const Foreign foreign = foreign_of(o);
  const auto answered = answered_in(o.directory);
  const fuzz::Causes causes = sources.causes();
  fuzz::Ledger ledger(o.ledger);
  const std::string subject = resolved_subject(o, foreign, answered, ledger.all());
  std::deque<EnginesByCard> of_job;
  std::vector<fuzz::TriageConfig> jobs;
  for (int i = 0; i < o.jobs; ++i) {
    of_job.emplace_back(o.limits, foreign, o.error);
    jobs.push_back(config_of(date, of_job.back()));
  }
  const auto triaged = fuzz::triage(causes.causes, ledger, jobs);
  for (const fuzz::Triaged& t : triaged)
    if (!t.trouble.empty())
      fmt::print(stderr, "touchstone: {}: {}\n", t.cause.id, printable(t.trouble, "\n"));
  if (!o.reproducers.empty()) write_causes(o.reproducers, sources, causes);
  if (!o.junit.empty()) write_file(o.junit, reports::triage_junit(triaged));
  fmt::print("{}",
             o.json ? json_text(reports::triage_json(triaged), 1) + "\n" : reports::triage_text(triaged));
  const int code = say(verdict_on(subject, answered, triaged), o.json);
  // The commit comes last: what is in the ledger is no longer new, so every report of it must be out by then.
  require_stdout_written();
  ledger.commit();
  return code;
}

int change_suppression(const TriageOptions& o) {
  require_regular_file(o.ledger);
  fuzz::Ledger ledger(o.ledger);
  if (o.suppress.empty())
    fuzz::unsuppress(ledger, o.unsuppress);
  else
    fuzz::suppress(ledger, o.suppress, o.reason, o.until, date_of_run(o.date));
  ledger.commit();
  if (o.suppress.empty())
    fmt::print("{}: {} counts again\n", o.ledger, o.unsuppress);
  else
    fmt::print("{}: {} is suppressed through {}\n", o.ledger, o.suppress, o.until);
  return exit_clean;
}

int run(const TriageOptions& o) {
  if (!o.suppress.empty() || !o.unsuppress.empty()) return change_suppression(o);
  if (o.directory.empty())
    throw InputError("triage", "needs the directory of a campaign (or --suppress ID, --unsuppress ID)");
  CausesSearch search;
  search.directory = o.directory;
  search.engines = o.engines;
  if (is_foreign(o.subject)) search.engines += (o.engines.empty() ? "" : ",") + o.subject;
  search.error = o.error;
  search.jobs = o.jobs;
  search.limits = o.limits;
  const auto causes = [&] {
    FoundCauses found = causes_of_campaign(search, false);
    if (found.interrupted) throw Stopped{};
    if (!found.not_stored.empty())
      fmt::print(stderr, "touchstone: {}: they will be found again\n", printable(found.not_stored, "\n"));
    return std::move(found.causes);
  };
  return triage_campaign(o, {causes, reports::cause_markdown});
}

}  // namespace

Run declare_triage(CLI::App& app) {
  auto o = std::make_shared<TriageOptions>();
  auto* directory =
      app.add_option("directory", o->directory,
                     "directory of a campaign (`fuzz --out`) with its causes (`touchstone causes`)");
  app.add_option("--ledger", o->ledger, "file of known causes; created if missing")->capture_default_str();
  app.add_option("--engines", o->engines,
                 "plug-ins and pipes whose causes are to be asked again: ./libmine.so, pipe:COMMAND");
  app.add_option("--subject", o->subject, "the engine whose new causes make the exit code 1, or all")
      ->capture_default_str();
  app.add_option("--junit", o->junit, "write the result as JUnit XML to this file: one test per cause");
  app.add_option("--reproducers", o->reproducers,
                 "directory for one subdirectory per cause of this campaign: case, certificate, and a C++ "
                 "program that shows it");
  app.add_option("--date", o->date, "date of the run, for the ledger (default: now)");
  app.add_option("--jobs", o->jobs, "number of causes asked again in parallel (default: 1)")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  add_error(app, o->error);
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  auto* suppress = app.add_option("--suppress", o->suppress,
                                  "record in the ledger, without a campaign, that this cause is not to count")
                       ->excludes(directory);
  app.add_option("--unsuppress", o->unsuppress, "record that this cause counts again")
      ->excludes(directory)
      ->excludes(suppress);
  auto* reason = app.add_option("--reason", o->reason, "why the cause is suppressed")->needs(suppress);
  auto* until =
      app.add_option("--until", o->until, "last day of the suppression: 2026-12-31")->needs(suppress);
  suppress->needs(reason)->needs(until);
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
