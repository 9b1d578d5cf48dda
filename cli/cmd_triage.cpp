// touchstone triage DIR: compares the findings of a campaign with the ledger of known ones.
#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <deque>
#include <filesystem>
#include <map>
#include <set>

#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/judged_by.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "fuzz/ask/evidence.h"
#include "fuzz/campaign/directory_lock.h"
#include "fuzz/judge/relation.h"
#include "fuzz/reproduce/reproducer.h"
#include "fuzz/shrink/keeps_finding.h"
#include "fuzz/triage/triage.h"
#include "reports/record/stored.h"
#include "reports/text/record_text.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

// Limits of the cases that the shrinker may try; if the finding is a hang, each try costs a second.
constexpr std::size_t max_tries = 4000, max_tries_if_slow = 8;

struct TriageOptions {
  std::string directory, ledger = "findings.db", engines, subject = "all", junit, date, reproducers, error;
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

// Engines outside the catalogue, by the names on their cards. Only the command line decides what is run: in a
// finding, a name is just a label.
using Foreign = std::map<std::string, std::string>;

Foreign foreign_engines(const TriageOptions& o) {
  Foreign r;
  std::vector<std::string> given;
  if (!o.engines.empty()) given = engine_names(o.engines);
  if (is_foreign(o.subject)) given.push_back(engine_names(o.subject).at(0));
  for (const std::string& name : given) {
    if (!is_foreign(name)) continue;
    const auto [it, added] = r.try_emplace(make_engine(name, o.limits)->card().name, name);
    if (!added && it->second != name)
      throw InputError("--engines", fmt::format("{} and {} are both called {}", it->second, name, it->first));
  }
  return r;
}

// Engines as findings name them, created on first use. An engine that is not available is null.
class Engines {
 public:
  Engines(const WorkerLimits& limits, const Foreign& foreign, std::string error)
      : limits_(limits), foreign_(foreign), error_(std::move(error)) {}
  const EnginePtr& named(const std::string& name) {
    const auto [it, added] = made_.try_emplace(name);
    if (added) it->second = made(name);
    if (added && it->second) it->second = judged_by(std::move(it->second), error_);
    return it->second;
  }

 private:
  EnginePtr made(const std::string& name) const try {
    const auto foreign = foreign_.find(name);
    if (foreign != foreign_.end()) return make_engine(foreign->second, limits_);
    return is_catalogued(name) ? make_engine(name, limits_) : nullptr;
  } catch (const InputError&) {
    return nullptr;  // not installed: its findings are reported as "not asked"
  }

  WorkerLimits limits_;
  const Foreign& foreign_;
  std::string error_;
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
                        slow ? max_tries_if_slow : max_tries)
        .smallest;
  };
  return c;
}

// Counts of what happened to the requested reproducers.
struct Reproducers {
  std::size_t written = 0, there = 0, without_engine = 0, not_shown = 0;
  std::vector<std::string> failed;
};

// Writes DIR/<key>/: case.json, the smallest case; certificate.json for `touchstone check`, if there is one;
// reproduce.cpp, if the engine has a writer. The directory is built under another name and then renamed, so
// an existing directory is complete and is left alone.
void write_reproducer(const std::filesystem::path& directory, const fuzz::KnownFinding& known,
                      const EnginePtr& engine, Reproducers& count) {
  if (!known.expired.empty()) return;
  const auto to = directory / known.key;
  if (std::filesystem::exists(to)) {
    ++count.there;
    return;
  }
  if (!engine) {
    ++count.without_engine;
    return;
  }
  const Case smallest = fuzz::case_of(known);
  auto findings = fuzz::findings_of({&smallest, 1}, engine, fuzz::FoundBy::both)[0];
  const auto finding = findings.find(known.key);
  if (finding == findings.end()) {
    ++count.not_shown;  // showed once but not again; the ledger keeps its case
    return;
  }
  const auto part = directory / (".part-" + known.key);
  std::filesystem::remove_all(part);
  std::filesystem::create_directories(part);
  StoredCase stored;
  stored.c = smallest;
  stored.description = "shows " + known.key;
  save_case(stored, part / "case.json");
  fuzz::write_evidence(finding->second);
  const fuzz::Json& certificate = finding->second.evidence_json.at("certificate");
  if (certificate.value("kind", "none") != "none")
    write_file((part / "certificate.json").string(), certificate.dump(1) + "\n");
  if (fuzz::has_reproducer(known.engine)) try {
      write_file((part / "reproduce.cpp").string(), fuzz::reproducer(finding->second, engine->card()));
    } catch (const std::exception& e) {
      write_file((part / "no_reproducer.txt").string(), std::string(e.what()) + "\n");
      // By design, relations get no program; anything else is our own error.
      if (!dynamic_cast<const InputError*>(&e)) count.failed.push_back(known.key + ": " + e.what());
    }
  std::filesystem::rename(part, to);
  ++count.written;
}

// A reproducer that cannot be written does not affect the others.
Reproducers write_reproducers(const std::string& directory, const std::vector<fuzz::Triaged>& triaged,
                              Engines& engines) {
  Reproducers count;
  for (const fuzz::Triaged& t : triaged) try {
      write_reproducer(directory, t.finding, engines.named(t.finding.engine), count);
    } catch (const std::exception& e) {
      count.failed.push_back(t.finding.key + ": " + e.what());
    }
  return count;
}

void print(const Reproducers& r, const std::string& directory) {
  std::string words =
      fmt::format("reproducers in {}: {} written, {} already there", directory, r.written, r.there);
  if (r.without_engine > 0)
    words += fmt::format(", {} skipped because their engines are missing (--engines adds plug-ins)",
                         r.without_engine);
  if (r.not_shown > 0)
    words += fmt::format(", {} skipped because their cases no longer show them", r.not_shown);
  if (!r.failed.empty()) words += fmt::format(", {} failed", r.failed.size());
  if (r.written + r.there == 0) words += "; the directory is empty";
  fmt::print(stderr, "{}\n", words);
  for (const std::string& failed : r.failed)
    fmt::print(stderr, "touchstone: no reproducer: {}\n", printable(failed));
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
  const auto file = std::filesystem::path(directory) / "summary.json";
  const fuzz::Json j = load_json(file, campaign_limits);
  const fuzz::CampaignResult r = fuzz::result_from_json(JsonReader(j, file.string()));
  std::set<std::string> names;
  for (const auto& [engine, questions] : r.tallies)
    if (r.answered_by(engine) + r.failed_of(engine) > 0) names.insert(engine);
  return names;
}

// The subject's name in findings, or "all".
std::string resolved_subject(const TriageOptions& o, const Foreign& foreign,
                             const std::set<std::string>& answered,
                             const std::vector<fuzz::KnownFinding>& known) {
  if (o.subject == "all") return o.subject;
  for (const auto& [card_name, name] : foreign)
    if (name == o.subject || card_name == o.subject) return card_name;
  if (is_catalogued(o.subject)) return o.subject;
  std::set<std::string> names = answered;
  for (const fuzz::KnownFinding& f : known) names.insert(f.engine);
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
  std::size_t fresh = 0, back = 0, troubled = 0;
};

Verdict verdict_on(const std::string& subject, const std::set<std::string>& answered,
                   const std::vector<fuzz::Triaged>& triaged) {
  Verdict v{subject == "all" ? "all engines" : subject};
  v.answered = subject == "all" ? !answered.empty() : answered.contains(subject);
  for (const fuzz::Triaged& t : triaged) {
    if (subject != "all" && subject != t.finding.engine) continue;
    v.answered |= t.asked > 0;
    v.fresh += t.standing == fuzz::Standing::fresh;
    v.back += t.standing == fuzz::Standing::back;
    v.troubled += !t.trouble.empty();
  }
  return v;
}

int say(const Verdict& v, bool json) {
  if (v.fresh + v.back > 0)
    return print_verdict(exit_wrong, v.subject, fmt::format("{} new findings, {} back", v.fresh, v.back),
                         json);
  if (v.troubled > 0)
    return print_verdict(exit_failed, v.subject, fmt::format("{} findings could not be triaged", v.troubled),
                         json);
  if (!v.answered)
    return print_verdict(exit_failed, v.subject, "it answered nothing; this campaign proves nothing", json);
  return print_verdict(exit_clean, v.subject, "no new findings", json);
}

void require_stdout_written() {
  if ((std::fflush(stdout) != 0 || std::ferror(stdout)) && errno != EPIPE)
    throw std::runtime_error(std::string("the output cannot be written: ") + std::strerror(errno));
}

int run(const TriageOptions& o) {
  if (!o.reproducers.empty()) make_directory("--reproducers", o.reproducers);
  if (!o.error.empty()) length_from_text(o.error);  // refuses a bad length at once
  require_writable(o.junit);
  const Foreign foreign = foreign_engines(o);
  const fuzz::DirectoryLock lock(o.directory, fuzz::DirectoryLock::For::reading);
  const auto found = fuzz::load_findings(o.directory);
  const auto answered = answered_in(o.directory);
  fuzz::Ledger ledger(o.ledger);
  const std::string subject = resolved_subject(o, foreign, answered, ledger.all());
  const std::string date = o.date.empty() ? now() : o.date;
  std::deque<Engines> of_job;
  std::vector<fuzz::TriageConfig> jobs;
  for (int i = 0; i < o.jobs; ++i) {
    of_job.emplace_back(o.limits, foreign, o.error);
    jobs.push_back(config_of(o, date, of_job.back()));
  }
  const auto triaged = fuzz::triage(found, ledger, jobs);
  for (const fuzz::Triaged& t : triaged)
    if (!t.trouble.empty())
      fmt::print(stderr, "touchstone: {}: {}\n", t.finding.key, printable(t.trouble, "\n"));
  if (!o.reproducers.empty()) print(write_reproducers(o.reproducers, triaged, of_job.front()), o.reproducers);
  if (!o.junit.empty()) write_file(o.junit, reports::triage_junit(triaged));
  fmt::print("{}", o.json ? reports::triage_json(triaged).dump(1) + "\n" : reports::triage_text(triaged));
  const int code = say(verdict_on(subject, answered, triaged), o.json);
  // The commit comes last: what is in the ledger is no longer new, so every report of it must be out by then.
  require_stdout_written();
  ledger.commit();
  return code;
}

}  // namespace

Run declare_triage(CLI::App& app) {
  auto o = std::make_shared<TriageOptions>();
  app.add_option("directory", o->directory, "directory of a campaign (`fuzz --out`)")->required();
  app.add_option("--ledger", o->ledger, "file of known findings; created if missing")->capture_default_str();
  app.add_option("--engines", o->engines,
                 "plug-ins and pipes whose findings are to be asked again: ./libmine.so, pipe:COMMAND");
  app.add_option("--subject", o->subject, "the engine whose new findings make the exit code 1, or all")
      ->capture_default_str();
  app.add_option("--junit", o->junit, "write the result as JUnit XML to this file");
  app.add_option(
      "--reproducers", o->reproducers,
      "directory for one subdirectory per finding: case, certificate, and a C++ program that shows it");
  app.add_option("--date", o->date, "date of the run, for the ledger (default: now)");
  app.add_option("--jobs", o->jobs, "number of findings shrunk in parallel")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--no-shrink", o->no_shrink, "store the cases of new findings without shrinking them");
  add_error(app, o->error);
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
