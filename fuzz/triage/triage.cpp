#include "fuzz/triage/triage.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/base/input_error.h"
#include "fuzz/shrink/reductions.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"

namespace touchstone::fuzz {
namespace {

std::string text_of(const Case& c) { return case_to_json(c).dump(); }

StoredFinding load_finding(const std::filesystem::path& directory) {
  const auto file = directory / "finding.json";
  const Json j = load_json(file);
  StoredFinding s;
  s.finding = finding_from_json(JsonReader(j, file.string()));
  s.c = load_case(directory / "case.json");
  return s;
}

// A finding that cannot be shrunk is stored as found.
Triaged fresh(const StoredFinding& s, const TriageConfig& config, const std::string& build) {
  const Finding& f = s.finding;
  const std::string key = f.key();
  Triaged t;
  Case smallest = s.c;
  try {
    if (!build.empty()) smallest = config.smallest(f.engine, key, s.c);
  } catch (const std::exception& e) {
    t.trouble = std::string("not shrunk: ") + e.what();
  }
  t.finding = {key,          f.engine,          f.question,        f.fault,     f.shapes, f.blame,
               f.degeneracy, f.magnitude,       config.date,       config.date, build,    build,
               f.count,      measure(smallest), text_of(smallest), f.words,     ""};
  return t;
}

Triaged seen(const StoredFinding& s, std::optional<KnownFinding> known, const TriageConfig& config) {
  const std::string build = config.build_of(s.finding.engine);
  if (!known) return fresh(s, config, build);
  Triaged t;
  t.standing = known->expired.empty() ? Standing::known : Standing::back;
  known->expired.clear();
  known->last_seen = config.date;
  known->count += s.finding.count;
  if (!build.empty()) known->last_build = build;
  t.finding = std::move(*known);
  return t;
}

Triaged retry_known(KnownFinding f, const TriageConfig& config) try {
  Triaged t;
  t.standing = Standing::not_asked;
  t.finding = f;
  const std::string build = config.build_of(f.engine);
  if (build.empty()) return t;
  const Case c = case_of(f);
  while (t.asked < asks_before_gone && (t.asked == 0 || t.shown < t.asked)) {
    ++t.asked;
    t.shown += config.ask(f.engine, c).contains(f.key);
  }
  t.standing = t.shown == t.asked ? Standing::still : t.shown > 0 ? Standing::flaky : Standing::gone;
  if (t.shown > 0) {
    t.finding.last_seen = config.date;
    t.finding.last_build = build;
  } else {
    t.finding.expired = config.date;
  }
  return t;
} catch (const std::exception& e) {
  Triaged t;
  t.standing = Standing::not_asked;
  t.finding = std::move(f);
  t.trouble = std::string("not asked: ") + e.what();
  return t;
}

}  // namespace

Case case_of(const KnownFinding& f) { return case_from_json(case_json_of(f), "ledger, " + f.key); }

std::vector<StoredFinding> load_findings(const std::filesystem::path& directory) {
  if (!std::filesystem::exists(directory / "state.json"))
    throw InputError(directory.string(), "does not hold a campaign; touchstone fuzz --out DIR creates one");
  std::vector<StoredFinding> r;
  if (std::filesystem::exists(directory / "findings"))
    for (const auto& entry : std::filesystem::directory_iterator(directory / "findings"))
      if (entry.is_directory()) r.push_back(load_finding(entry.path()));
  std::sort(r.begin(), r.end(),
            [](const auto& a, const auto& b) { return a.finding.key() < b.finding.key(); });
  return r;
}

namespace {

// One row of the result: found in this run, or known but not found.
struct Task {
  const StoredFinding* found = nullptr;
  std::optional<KnownFinding> known;
};

Triaged run_task(const Task& t, const TriageConfig& config) {
  return t.found ? seen(*t.found, t.known, config) : retry_known(*t.known, config);
}

// Each idle thread takes the next task and writes to that task's own place in the result.
std::vector<Triaged> run_tasks(const std::vector<Task>& tasks, std::span<const TriageConfig> jobs) {
  std::vector<Triaged> r(tasks.size());
  std::vector<std::exception_ptr> errors(tasks.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&](const TriageConfig& config) {
    for (std::size_t i = next++; i < tasks.size(); i = next++) try {
        r[i] = run_task(tasks[i], config);
      } catch (...) {
        errors[i] = std::current_exception();
      }
  };
  std::vector<std::thread> threads;
  for (std::size_t j = 1; j < jobs.size(); ++j) threads.emplace_back(work, std::cref(jobs[j]));
  work(jobs[0]);
  for (std::thread& t : threads) t.join();
  for (const auto& e : errors)
    if (e) std::rethrow_exception(e);
  return r;
}

}  // namespace

std::vector<Triaged> triage(const std::vector<StoredFinding>& found, Ledger& ledger,
                            std::span<const TriageConfig> jobs) {
  std::vector<Task> tasks;
  std::set<std::string> keys;
  for (const StoredFinding& s : found) {
    const std::string key = s.finding.key();
    tasks.push_back({&s, ledger.find(key)});
    keys.insert(key);
  }
  for (const KnownFinding& f : ledger.all())
    if (f.expired.empty() && !keys.contains(f.key)) tasks.push_back({nullptr, f});
  std::vector<Triaged> r = run_tasks(tasks, jobs);
  for (const Triaged& t : r) ledger.put(t.finding);
  std::sort(r.begin(), r.end(),
            [](const Triaged& a, const Triaged& b) { return a.finding.key < b.finding.key; });
  return r;
}

}  // namespace touchstone::fuzz
