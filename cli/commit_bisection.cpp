#include "cli/commit_bisection.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/adapter_build.h"
#include "cli/command.h"
#include "cli/library_commits.h"
#include "cli/logged_command.h"
#include "cli/own_engines.h"
#include "core/base/input_error.h"
#include "fuzz/shrink/keeps_finding.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

using CommitVerdict = LibraryCommits::Verdict;

std::string engine_of_key(const std::string& key, const std::vector<PluginEngine>& engines) {
  std::string found;
  for (const PluginEngine& e : engines)
    if (key.starts_with(e.engine + ".") && e.engine.size() > found.size()) found = e.engine;
  return found;
}

// What is asked of every commit. Everything that can be wrong with the command line is wrong here.
class CommitQuestion {
 public:
  CommitQuestion(const FindingArgument& f, const std::string& source, const CommitOptions& o,
                 const WorkerLimits& limits)
      : case_(case_argument(f.path).c),
        engine_(name_in_adapter(f.engine)),
        key_(f.key.empty() ? stored_key(f.path) : f.key),
        limits_(limits),
        commits_({source, adapter_named(engine_), o.cmake_options, o.cache}) {}

  CommitVerdict ask(const std::string& commit) try {
    const auto engines = engines_in(commits_.plugins_at(commit));
    const PluginEngine& engine = chosen(engines);
    const std::string name = engine.plugin.string() + ":" + engine.engine;
    const bool about_it = key_.starts_with(engine.engine + ".");
    const auto found =
        fuzz::findings_of({&case_, 1}, make_engine(name, limits_), fuzz::found_by(about_it ? key_ : ""))[0];
    const bool wrong = about_it ? found.contains(key_) : !found.empty();
    const std::string shown = !wrong ? engine.engine : about_it ? key_ : found.begin()->first;
    fmt::print(stderr, "{}  {}\n    {}\n", wrong ? "bad " : "good", commits_.line_of(commit),
               printable(shown));
    return wrong ? CommitVerdict::bad : CommitVerdict::good;
  } catch (const InputError& e) {
    return skip(commit, e.what());
  } catch (const CommandFailed& e) {
    return skip(commit, e.what());
  }

  LibraryCommits& commits() { return commits_; }

 private:
  static std::string adapter_named(const std::string& engine) {
    if (engine.empty()) throw InputError("--source", "needs --engine: the adapter or engine to build");
    const std::string adapter = adapter_of(engine);
    require_adapter(adapter.empty() ? engine : adapter);
    return adapter;
  }

  // The engine named, else that of the finding, else the adapter's first.
  const PluginEngine& chosen(const std::vector<PluginEngine>& engines) const {
    const std::string of_key = engine_of_key(key_, engines);
    for (const std::string& name : {engine_, of_key})
      for (const PluginEngine& e : engines)
        if (e.engine == name) return e;
    if (engine_ != adapter_of(engine_))
      throw InputError("--engine " + engine_, "is not offered at this commit");
    const auto first = std::find_if(engines.begin(), engines.end(),
                                    [](const PluginEngine& e) { return e.kind == EngineKind::pairs; });
    if (first == engines.end())
      throw InputError("--engine " + engine_, "offers no engine that answers pairs");
    return *first;
  }

  CommitVerdict skip(const std::string& commit, const std::string& why) {
    fmt::print(stderr, "skip  {}\n    {}\n", commits_.line_of(commit), printable(why, "\n"));
    return CommitVerdict::skip;
  }

  Case case_;
  std::string engine_, key_;
  WorkerLimits limits_;
  LibraryCommits commits_;
};

int exit_code_of(CommitVerdict v) {
  return v == CommitVerdict::good ? exit_clean : v == CommitVerdict::bad ? exit_wrong : exit_skip;
}

// The ends of the range must be what the user says they are.
void require_verdict(CommitQuestion& question, const std::string& commit, CommitVerdict expected,
                     const std::string& option) {
  const CommitVerdict v = question.ask(commit);
  if (v == expected) return;
  throw CommandFailed(v == CommitVerdict::skip          ? option + " cannot be tested"
                      : expected == CommitVerdict::good ? option + " is wrong already"
                                                        : option + " is right: there is nothing to look for");
}

int search_commits(CommitQuestion& question, const CommitOptions& o) {
  LibraryCommits& commits = question.commits();
  const std::string good = commits.hash_of(o.good), bad = commits.hash_of(o.bad);
  require_verdict(question, good, CommitVerdict::good, "--good " + o.good);
  require_verdict(question, bad, CommitVerdict::bad, "--bad " + o.bad);
  const auto found =
      commits.first_bad(good, bad, [&](const std::string& commit) { return question.ask(commit); });
  const std::string built =
      fmt::format("{} built, {} taken from the cache", commits.built(), commits.reused());
  if (!found.first_bad.empty()) {
    fmt::print("first bad commit: {}\n{}\n", commits.line_of(found.first_bad), built);
    return exit_clean;
  }
  fmt::print("the first bad commit is one of these, which do not build:\n");
  for (const std::string& commit : found.suspects) fmt::print("    {}\n", commits.line_of(commit));
  fmt::print("{}\n", built);
  return exit_failed;
}

}  // namespace

int bisect_commits(const FindingArgument& finding, const CommitOptions& o, const WorkerLimits& limits) {
  if (!o.good.empty()) {
    CommitQuestion question(finding, o.source, o, limits);
    return search_commits(question, o);
  }
  try {
    CommitQuestion question(finding, o.source, o, limits);
    return exit_code_of(question.ask(question.commits().hash_of(o.commit)));
  } catch (const InputError& e) {
    fmt::print(stderr, "touchstone: {}\n", printable(e.what(), "\n"));
    return exit_abort;
  }
}

}  // namespace touchstone::cli
