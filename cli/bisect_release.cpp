#include "cli/bisect_release.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/case_argument.h"
#include "cli/engine_catalog.h"
#include "cli/npm_releases.h"
#include "cli/release_engines.h"
#include "core/base/input_error.h"
#include "fuzz/bisect/releases.h"
#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

struct Options {
  FindingArgument finding;
  ReleaseChoice choice;
  std::string bad;
  bool json = false;
  WorkerLimits limits;
};

struct Tried {
  std::string release;
  fuzz::Verdict verdict;
  fuzz::ReleaseSays says;
};

std::string_view name_of(fuzz::Verdict v) {
  return v == fuzz::Verdict::good ? "good" : v == fuzz::Verdict::bad ? "bad" : "skip";
}

// Puts the case to one release after the other and remembers what they say.
class Asker {
 public:
  Asker(const NpmRow& row, Case c, fuzz::FaultSought sought, const WorkerLimits& limits)
      : row_(row), case_(std::move(c)), sought_(std::move(sought)), engines_(limits) {}

  fuzz::Verdict ask(const std::string& release) {
    const NpmEngine e{&row_, release};
    const EnginePtr& engine = engines_.of(e);
    const fuzz::ReleaseSays says = engine ? fuzz::ask_release(case_, sought_, engine)
                                          : fuzz::ReleaseSays{fuzz::Showing::lacks, engines_.why_not(e)};
    tried_.push_back({release, fuzz::verdict_of(says), says});
    const std::string words = says.words.empty() ? std::string(to_string(says.showing)) : says.words;
    fmt::print(
        stderr, "{}\n",
        reports::wrapped(
            fmt::format("{:<8} {} {}", release, name_of(tried_.back().verdict), printable(words)), 78, 14));
    return tried_.back().verdict;
  }
  const std::vector<Tried>& tried() const { return tried_; }

 private:
  const NpmRow& row_;
  Case case_;
  fuzz::FaultSought sought_;
  ReleaseEngines engines_;
  std::vector<Tried> tried_;
};

// The releases up to the one that is known to be bad: --bad, or the newest.
std::vector<std::string> releases_to_search(const NpmRow& row, const Options& o) {
  std::vector<std::string> releases = chosen_releases(row, o.choice);
  if (o.bad.empty()) return releases;
  const std::string bad = newest_matching(releases, o.bad);
  if (bad.empty()) throw InputError("--bad " + o.bad, fmt::format("{} has no such release", row.package));
  releases.erase(std::find(releases.begin(), releases.end(), bad) + 1, releases.end());
  return releases;
}

// The finding of this key, which may be of any release; its engine's name becomes that of `name`.
std::string key_for(const std::string& key, const NpmRow& row, const std::string& name) {
  const std::string base(row.name);
  if (key.starts_with(base + ".")) return name + key.substr(base.size());
  if (!key.starts_with(base + "@")) return key;
  std::size_t end = key.find('.', base.size());  // of the release's three numbers
  for (int dots = 0; dots < 2 && end != std::string::npos; ++dots) end = key.find('.', end + 1);
  return end == std::string::npos ? key : name + key.substr(end);
}

std::string conclusion(const std::vector<std::string>& releases, const fuzz::FirstBad& found) {
  if (!found.good && found.skipped.empty())
    return fmt::format("first bad: {}, the oldest release", releases[found.bad]);
  if (found.skipped.empty())
    return fmt::format("first bad: {} ({} is good)", releases[found.bad], releases[*found.good]);
  std::string skipped;
  for (const std::size_t i : found.skipped) skipped += (skipped.empty() ? "" : ", ") + releases[i];
  return fmt::format("first bad: {}, or one of those that cannot be asked: {} ({})", releases[found.bad],
                     skipped,
                     found.good ? fmt::format("{} is good", releases[*found.good]) : "none before is good");
}

nlohmann::ordered_json json_of(const std::string& key, const std::vector<std::string>& releases,
                               const fuzz::FirstBad& found, const std::vector<Tried>& tried) {
  nlohmann::ordered_json j{{"key", key}, {"first_bad", releases[found.bad]}, {"good", nullptr}};
  if (found.good) j["good"] = releases[*found.good];
  j["skipped"] = nlohmann::ordered_json::array();
  for (const std::size_t i : found.skipped) j["skipped"].push_back(releases[i]);
  for (const Tried& t : tried)
    j["tried"].push_back({{"release", t.release}, {"verdict", name_of(t.verdict)}, {"words", t.says.words}});
  return j;
}

int run(const Options& o) {
  if (o.finding.engine.empty()) throw InputError("bisect release", "needs --engine, an engine from npm");
  const NpmRow& row = npm_row_named(o.finding.engine);
  const std::vector<std::string> releases = releases_to_search(row, o);
  FindingArgument of_newest = o.finding;
  of_newest.engine = NpmEngine{&row, releases.back()}.name();
  of_newest.key = key_for(of_newest.key, row, of_newest.engine);
  ReleaseEngines(o.limits).of({&row, releases.back()});  // installs it
  const AskedFinding asked = ask_for_finding(of_newest, o.limits);
  if (asked.key.empty()) {
    fmt::print(stderr, "touchstone: {} is not found wrong; name an older release that is with --bad\n",
               of_newest.engine);
    return exit_failed;
  }
  Asker asker(row, asked.stored.c, fuzz::fault_in(asked.key, of_newest.engine), o.limits);
  const fuzz::FirstBad found =
      fuzz::first_bad(releases.size(), [&](std::size_t i) { return asker.ask(releases[i]); });
  if (o.json)
    fmt::print("{}\n", json_of(asked.key, releases, found, asker.tried()).dump(1));
  else
    fmt::print("{}\n{} releases, {} asked\n{}\n", asked.key, releases.size(), asker.tried().size() + 1,
               reports::wrapped(conclusion(releases, found), 78, 2));
  return exit_clean;
}

}  // namespace

Run declare_bisect_release(CLI::App& app) {
  auto o = std::make_shared<Options>();
  add_finding_argument(app, o->finding);
  app.add_option("--bad", o->bad, "a release that shows the finding (default: the newest)");
  add_release_choice(app, o->choice);
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
