// touchstone triage DIR: the findings of a campaign against the ledger of known ones.
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <deque>
#include <filesystem>
#include <map>

#include "core/base/input_error.h"
#include "core/scene/input_file.h"
#include "fuzz/cli/command.h"
#include "fuzz/cli/engine_catalog.h"
#include "fuzz/judge/relation.h"
#include "fuzz/reproduce/reproducer.h"
#include "fuzz/shrink/keeps_finding.h"
#include "fuzz/triage/triage.h"
#include "reports/triage_text.h"
#include "scenarios/case_codec.h"

namespace touchstone::cli {
namespace {

// Cases that the shrinker may ask about; each costs a second where the finding is that the engine hangs.
constexpr std::size_t all_tries = 4000, tries_of_slow = 8;

struct TriageOptions {
  std::string directory, ledger = "findings.db", subject = "all", junit, date, reproducers;
  bool json = false, no_shrink = false;
  int jobs = 1;
  WorkerLimits limits;
};

// The date and time, UTC.
std::string now() {
  const std::time_t t = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&t, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

// Engines as findings name them, made when first asked for. An engine that is not here is null.
class Engines {
 public:
  explicit Engines(const WorkerLimits& limits) : limits_(limits) {}
  const EnginePtr& named(const std::string& name) {
    const auto [it, added] = made_.try_emplace(name);
    if (added) try {
        it->second = make_engine(engine_names(name).at(0), limits_);
      } catch (const InputError&) {
        // Not in the catalog, or not installed: its findings are "not asked", which the report says.
      }
    return it->second;
  }

 private:
  WorkerLimits limits_;
  std::map<std::string, EnginePtr> made_;
};

fuzz::TriageConfig config_of(const TriageOptions& o, const std::string& date, Engines& engines) {
  fuzz::TriageConfig c;
  c.date = date;
  c.build_of = [&](const std::string& engine) {
    const EnginePtr& e = engines.named(engine);
    return e ? e->card().library + " " + e->card().version : std::string();
  };
  c.ask = [&](const std::string& engine, const Case& asked) {
    return fuzz::findings_of({&asked, 1}, engines.named(engine), fuzz::FoundBy::both)[0];
  };
  c.smallest = [&, shrink = !o.no_shrink](const std::string& engine, const std::string& key,
                                          const Case& found) {
    if (!shrink) return found;
    const bool slow = key.find(".timed_out.") != std::string::npos;
    return fuzz::shrink(found, fuzz::keeps_finding(engines.named(engine), key),
                        slow ? tries_of_slow : all_tries)
        .smallest;
  };
  return c;
}

// DIR/<key>/: case.json, the smallest case; certificate.json, what `touchstone check` verifies, when there is
// one; reproduce.cpp, where the engine has a writer. Directories that are there already stay as they are.
void write_reproducer(const std::filesystem::path& directory, const fuzz::KnownFinding& known,
                      const EnginePtr& engine) {
  if (!engine || !known.expired.empty() || std::filesystem::exists(directory / known.key)) return;
  const Case smallest = fuzz::case_of(known);
  const auto findings = fuzz::findings_of({&smallest, 1}, engine, fuzz::FoundBy::both)[0];
  const auto finding = findings.find(known.key);
  if (finding == findings.end()) return;  // came once and not again; the ledger keeps its case
  const auto to = directory / known.key;
  std::filesystem::create_directories(to);
  StoredCase stored;
  stored.c = smallest;
  stored.description = "shows " + known.key;
  save_case(stored, to / "case.json");
  const auto evidence = finding->second.evidence_json();
  if (evidence.contains("certificate") && evidence["certificate"].value("kind", "none") != "none")
    write_file((to / "certificate.json").string(), evidence["certificate"].dump(1) + "\n");
  if (!fuzz::has_reproducer(known.engine)) return;
  try {
    write_file((to / "reproduce.cpp").string(), fuzz::reproducer(finding->second, engine->card()));
  } catch (const InputError& e) {
    write_file((to / "no_reproducer.txt").string(), std::string(e.what()) + "\n");
  }
}

// Before any work is done: a directory that cannot be had is bad usage.
void make_directory(const std::string& option, const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path))
    throw InputError(option, fmt::format("{} cannot be made a directory: {}", path,
                                         error ? error.message() : "it is something else"));
}

int run(const TriageOptions& o) {
  if (!o.reproducers.empty()) make_directory("--reproducers", o.reproducers);
  const auto found = fuzz::load_findings(o.directory);
  fuzz::Ledger ledger(o.ledger);
  const std::string date = o.date.empty() ? now() : o.date;
  std::deque<Engines> of_job;
  std::vector<fuzz::TriageConfig> jobs;
  for (int i = 0; i < o.jobs; ++i) {
    of_job.emplace_back(o.limits);
    jobs.push_back(config_of(o, date, of_job.back()));
  }
  Engines& engines = of_job.front();
  const auto triaged = fuzz::triage(found, ledger, jobs);
  ledger.commit();
  if (!o.reproducers.empty())
    for (const fuzz::Triaged& t : triaged)
      write_reproducer(o.reproducers, t.finding, engines.named(t.finding.engine));
  if (!o.junit.empty()) write_file(o.junit, reports::triage_junit(triaged));
  if (o.json)
    fmt::print("{}\n", reports::triage_json(triaged).dump(1));
  else
    fmt::print("{}", reports::triage_text(triaged));
  for (const fuzz::Triaged& t : triaged)
    if ((t.standing == fuzz::Standing::fresh || t.standing == fuzz::Standing::back) &&
        (o.subject == "all" || o.subject == t.finding.engine))
      return exit_wrong;
  return exit_clean;
}

}  // namespace

Run declare_triage(CLI::App& app) {
  auto o = std::make_shared<TriageOptions>();
  app.add_option("directory", o->directory, "of a campaign (touchstone fuzz --out)")->required();
  app.add_option("--ledger", o->ledger, "the file of known findings; made when it is not there")
      ->capture_default_str();
  app.add_option("--subject", o->subject, "the engine whose new findings make the exit code 1, or all")
      ->capture_default_str();
  app.add_option("--junit", o->junit, "write the result as JUnit XML to this file");
  app.add_option(
      "--reproducers", o->reproducers,
      "directory that gets one directory a finding: case, certificate, a C++ program that shows it");
  app.add_option("--date", o->date, "of the run, for the ledger (default: now)");
  app.add_option("--jobs", o->jobs, "findings shrunk side by side")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--no-shrink", o->no_shrink, "store cases of new findings as they were found");
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
