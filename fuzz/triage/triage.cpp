#include "fuzz/triage/triage.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>
#include <tuple>

#include "core/base/input_error.h"
#include "reports/record/result.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/iso_date.h"

namespace touchstone::fuzz {
namespace {

// Sorts and removes repetitions.
std::vector<std::string> as_list(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

// Adds `more` to the list; returns what was not in it.
std::vector<std::string> add(std::vector<std::string>& list, const std::vector<std::string>& more) {
  std::vector<std::string> fresh;
  for (const std::string& word : as_list(more))
    if (!std::binary_search(list.begin(), list.end(), word)) fresh.push_back(word);
  list.insert(list.end(), fresh.begin(), fresh.end());
  std::sort(list.begin(), list.end());
  return fresh;
}

void take_case(KnownCause& k, const CauseCase& shown) {
  if (shown.c.is_null()) return;
  k.engine = shown.engine;
  k.key = shown.key;
  k.shown = to_line(shown.c);
  k.words = shown.words;
  k.size = shown.size;
}

// What this run says of a cause replaces what the ledger said.
void take_description(KnownCause& k, const Cause& c, const std::string& date) {
  k.path = c.path;
  k.title = c.title;
  k.documented = c.documented;
  k.severity = std::min(k.severity, c.severity);
  k.last_seen = date;
  k.last_build = c.library;
  k.count += c.wrong;
}

Triaged fresh(const Cause& c, const std::string& date) {
  Triaged t;
  t.cause.id = c.id;
  t.cause.first_seen = date;
  t.cause.first_build = c.library;
  take_description(t.cause, c, date);
  take_case(t.cause, c.shown());
  add(t.cause.engines, c.engines);
  add(t.cause.shapes, c.shapes);
  return t;
}

// Of a failure at one place in the code, whose key names no shapes, other shapes are no news.
bool has_shapes(const Cause& c) {
  const auto f = finding_of_key(c.shown().engine, c.shown().key);
  return !f || f->shapes != any_shapes;
}

// A case that no longer showed its cause is replaced by one that does.
Triaged seen_again(const Cause& c, KnownCause known, const std::string& date) {
  Triaged t;
  t.cause = std::move(known);
  KnownCause& k = t.cause;
  const bool is_back = !k.expired.empty();
  take_description(k, c, date);
  if (is_back || k.shown.empty() || c.shown().size < k.size) take_case(k, c.shown());
  k.expired.clear();
  add(k.engines, c.engines);
  t.new_shapes = add(k.shapes, c.shapes);
  if (!has_shapes(c)) t.new_shapes.clear();
  t.standing = is_back ? Standing::back : t.new_shapes.empty() ? Standing::known : Standing::changed;
  return t;
}

Triaged retry_known(const KnownCause& k, const TriageConfig& config) try {
  Triaged t;
  t.standing = Standing::not_asked;
  t.cause = k;
  if (k.shown.empty()) return t;
  const std::string build = config.build_of(k.engine);
  if (build.empty()) return t;
  const Case c = case_of(k);
  while (t.asked < asks_before_gone && (t.asked == 0 || t.shown < t.asked)) {
    ++t.asked;
    t.shown += shows_again(k.engine, k.key, config.ask(k.engine, c));
  }
  t.standing = t.shown == t.asked ? Standing::still : t.shown > 0 ? Standing::flaky : Standing::gone;
  if (t.shown > 0) {
    t.cause.last_seen = config.date;
    t.cause.last_build = build;
  } else {
    t.cause.expired = config.date;
  }
  return t;
} catch (const std::exception& e) {
  Triaged t;
  t.standing = Standing::not_asked;
  t.cause = k;
  t.trouble = std::string("not asked: ") + e.what();
  return t;
}

// One row of the result: found in this run, or known but not found.
struct Task {
  const Cause* found = nullptr;
  std::optional<KnownCause> known;
};

Triaged run_task(const Task& t, const TriageConfig& config) {
  if (!t.found) return retry_known(*t.known, config);
  return t.known ? seen_again(*t.found, *t.known, config.date) : fresh(*t.found, config.date);
}

// A suppression that has ended counts as long as the cause is shown: until somebody decides again.
Triaged with_suppression(Triaged t, const std::string& date) {
  if (t.cause.until.empty() || t.standing == Standing::gone) return t;
  const bool ended = date.substr(0, iso_date_length) > t.cause.until;
  if (!ended)
    t.standing = Standing::suppressed;
  else
    t.suppression_ended = t.standing != Standing::not_asked;
  return t;
}

// Each idle thread takes the next task and writes to that task's own place in the result.
std::vector<Triaged> run_tasks(const std::vector<Task>& tasks, std::span<const TriageConfig> jobs) {
  std::vector<Triaged> r(tasks.size());
  std::vector<std::exception_ptr> errors(tasks.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&](const TriageConfig& config) {
    for (std::size_t i = next++; i < tasks.size(); i = next++) try {
        r[i] = with_suppression(run_task(tasks[i], config), config.date);
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

// The known causes that are to be asked again.
std::vector<KnownCause> not_found(const Ledger& ledger, const std::set<std::string>& found) {
  std::vector<KnownCause> r = ledger.all();
  std::erase_if(r, [&](const KnownCause& k) { return !k.expired.empty() || found.contains(k.id); });
  std::stable_sort(r.begin(), r.end(),
                   [](const KnownCause& x, const KnownCause& y) { return x.severity < y.severity; });
  return r;
}

}  // namespace

Case case_of(const KnownCause& k) { return case_from_json(case_json_of(k), "ledger, " + k.id); }

bool shows_again(const std::string& engine, const std::string& key,
                 const std::map<std::string, Finding>& found) {
  const auto sought = finding_of_key(engine, key);
  return sought && std::any_of(found.begin(), found.end(), [&](const auto& f) {
           return f.second.engine == engine && f.second.question == sought->question &&
                  kind_of_fault(f.second.fault) == kind_of_fault(sought->fault);
         });
}

std::vector<Triaged> triage(const std::vector<Cause>& found, Ledger& ledger,
                            std::span<const TriageConfig> jobs) {
  std::vector<Task> tasks;
  std::set<std::string> ids;
  for (const Cause& c : found) {
    if (!ids.insert(c.id).second) throw InputError(c.id, "is the id of two causes");
    tasks.push_back({&c, ledger.find(c.id)});
  }
  for (KnownCause& k : not_found(ledger, ids)) tasks.push_back({nullptr, std::move(k)});
  std::vector<Triaged> r = run_tasks(tasks, jobs);
  for (const Triaged& t : r) ledger.put(t.cause);
  return r;
}

}  // namespace touchstone::fuzz
