// touchstone bisect bodies|step|stage|value|commit|release CASE: what a finding depends on.
#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/bisect_release.h"
#include "cli/case_argument.h"
#include "cli/command.h"
#include "cli/commit_bisection.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "fuzz/bisect/bisect.h"
#include "scenarios/codec/scene_fields.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;

struct BisectOptions {
  FindingArgument finding;
  std::string out, at, build;
  double to = 0;
  bool json = false;
  CommitOptions commits;
  WorkerLimits limits;
};

template <class T>
std::string listed(const std::vector<T>& all, std::string_view between) {
  std::string out;
  for (const T& x : all) {
    if (!out.empty()) out += between;
    out += fmt::format("{}", x);
  }
  return out;
}

void keep(const BisectOptions& o, const AskedFinding& asked, Case c, const std::string& what) {
  if (o.out.empty()) return;
  StoredCase stored;
  stored.c = std::move(c);
  stored.description = "shows " + asked.key + "; " + what;
  stored.source = "from " + (asked.stored.source.empty() ? asked.stored.c.id : asked.stored.source);
  save_case(stored, o.out);
}

int bodies(const BisectOptions& o, const AskedFinding& asked, const fuzz::Finding& f) {
  const auto r = fuzz::which_bodies(asked.stored.c, fuzz::commits_fault(asked.engine, f));
  keep(o, asked, r.smallest, "only the bodies it needs");
  if (o.json)
    fmt::print("{}\n", Json{{"key", asked.key}, {"bodies", r.bodies}}.dump(1));
  else
    fmt::print("{}\nneeds {} of {} bodies: {}\n", asked.key, r.bodies.size(),
               asked.stored.c.scene.bodies.size(), listed(r.bodies, " "));
  return exit_clean;
}

std::string describe(const Step& s) {
  const std::string_view name = scene_fields::op_names[static_cast<std::size_t>(s.op)];
  return s.op == Step::Op::query ? std::string(name) : fmt::format("{} body {}", name, s.body);
}

int step(const BisectOptions& o, const AskedFinding& asked, const fuzz::Finding& f) {
  const auto r = fuzz::which_step(asked.stored.c, fuzz::commits_fault(asked.engine, f));
  keep(o, asked, r.shortest, "up to the first query that shows it");
  std::vector<std::string> changes;
  for (const Step& s : r.changes) changes.push_back(describe(s));
  if (o.json)
    fmt::print(
        "{}\n",
        Json{{"key", asked.key}, {"query", r.query}, {"queries", r.queries}, {"changes", changes}}.dump(1));
  else
    fmt::print("{}\nfirst shows at query {} of {} (counted from 0), after: {}\n", asked.key, r.query,
               r.queries, changes.empty() ? "nothing changed" : listed(changes, ", "));
  return exit_clean;
}

int stage(const BisectOptions& o, const AskedFinding& asked, const fuzz::Finding& f) {
  const fuzz::Evidence& e = *f.evidence;
  if (e.a < 0 || e.b < 0) throw InputError("bisect stage", "the finding names no pair of bodies");
  const auto all = fuzz::which_stage(asked.stored.c, e.a, e.b, e.step, asked.engine);
  const auto first =
      std::find_if(all.begin(), all.end(), [](const fuzz::Stage& s) { return !s.faults.empty(); });
  if (o.json) {
    Json j{{"key", asked.key}, {"first", first == all.end() ? "" : std::string(first->name)}};
    for (const fuzz::Stage& s : all) j["stages"][std::string(s.name)] = s.faults;
    fmt::print("{}\n", j.dump(1));
    return exit_clean;
  }
  fmt::print("{}\nbodies {} and {} alone, in the order an engine works:\n", asked.key, e.a, e.b);
  for (const fuzz::Stage& s : all)
    fmt::print("  {:<20} {}\n", s.name, s.faults.empty() ? "-" : listed(s.faults, ", "));
  if (first == all.end())
    fmt::print("no stage is wrong for these two alone: other bodies or the script matter\n");
  else
    fmt::print("first wrong: {}\n", first->name);
  return exit_clean;
}

int value(const BisectOptions& o, const AskedFinding& asked, const fuzz::Finding& f) {
  const auto t = fuzz::which_value(asked.stored.c, o.at, o.to, fuzz::commits_fault(asked.engine, f));
  if (o.json)
    fmt::print("{}\n", Json{{"key", asked.key},
                            {"at", o.at},
                            {"shows", t.shows},
                            {"shows_not", t.shows_not},
                            {"neighbours", t.neighbours},
                            {"tried", t.tried}}
                           .dump(1));
  else
    fmt::print("{}\n{}: shows at {} but not at {}{} ({} cases tried)\n", asked.key, o.at, t.shows,
               t.shows_not, t.neighbours ? ", the next double" : "", t.tried);
  return exit_clean;
}

int commit(const BisectOptions& o) {
  if (!o.commits.source.empty()) return bisect_commits(o.finding, o.commits, o.limits);
  if (!o.build.empty() && std::system(o.build.c_str()) != 0) {
    fmt::print(stderr, "the build failed: {}\n", o.build);
    return exit_skip;
  }
  try {
    const AskedFinding asked = ask_for_finding(o.finding, o.limits);
    fmt::print("{}\n", asked.key.empty() ? "right" : "wrong: " + asked.key);
    return asked.key.empty() ? exit_clean : exit_wrong;
  } catch (const InputError& e) {
    fmt::print(stderr, "touchstone: {}\n", printable(e.what(), "\n"));
    return exit_skip;
  }
}

void add_commit_options(CLI::App& app, BisectOptions& o) {
  CommitOptions& c = o.commits;
  auto* build =
      app.add_option("--build", o.build, "command that builds the engine first; exit code 125 if it fails");
  auto* source =
      app.add_option("--source", c.source,
                     "git repository of the engine's library: it is built by CMake and the adapter of "
                     "--engine compiled against it")
          ->excludes(build);
  auto* one =
      app.add_option("--commit", c.commit, "the commit to answer for")->capture_default_str()->needs(source);
  auto* good = app.add_option("--good", c.good, "search from this commit, which is right, …")->needs(source);
  good->excludes(one);
  app.add_option("--bad", c.bad, "… to this one, which is wrong")->capture_default_str()->needs(good);
  app.add_option("--cmake", c.cmake_options,
                 "option for the library's CMake, as --cmake=-DNAME=VALUE; repeatable")
      ->allow_extra_args(false)
      ->needs(source);
  app.add_option("--cache", c.cache,
                 "folder for the libraries built (default: touchstone/libraries in "
                 "$XDG_CACHE_HOME)")
      ->needs(source);
}

using Verb = int (*)(const BisectOptions&, const AskedFinding&, const fuzz::Finding&);

struct Row {
  const char *name, *line;
  Verb run;  // null: commit
};
constexpr Row verbs[] = {
    {"bodies", "the fewest bodies that show the finding", bodies},
    {"step", "the first query of the script that shows it", step},
    {"stage", "the first stage of the engine that is wrong", stage},
    {"value", "the value of one number at which it begins", value},
    {"commit", "the commit of the engine's library that introduced it", nullptr},
};

int run(const BisectOptions& o, Verb verb) {
  if (!verb) return commit(o);
  prepare_output(o.out);
  const AskedFinding asked = ask_for_finding(o.finding, o.limits);
  if (asked.key.empty()) return not_found(asked, o.finding);
  return verb(o, asked, asked.findings.at(asked.key));
}

}  // namespace

Run declare_bisect(CLI::App& app) {
  auto o = std::make_shared<BisectOptions>();
  auto verb = std::make_shared<Verb>(nullptr);
  app.require_subcommand(1);
  for (const Row& row : verbs) {
    CLI::App* sub = app.add_subcommand(row.name, row.line);
    add_finding_argument(*sub, o->finding);
    add_case_seconds(*sub, o->limits);
    const std::string name = row.name;
    if (name == "commit") {
      add_commit_options(*sub, *o);
    } else {
      sub->add_flag("--json", o->json, "one JSON document on stdout");
    }
    if (name == "bodies" || name == "step") sub->add_option("-o,--out", o->out, "file for the reduced case");
    if (name == "value") {
      sub->add_option("--at", o->at, "JSON pointer to the number, e.g. /scene/bodies/1/pose/translation/0")
          ->required();
      sub->add_option("--to", o->to, "a value that does not show the finding")->required();
    }
    sub->callback([verb, run = row.run] { *verb = run; });
  }
  auto other = std::make_shared<Run>();
  CLI::App* release = app.add_subcommand("release", "the first release on npm that shows it");
  release->callback([other, run_release = declare_bisect_release(*release)] { *other = run_release; });
  return [o, verb, other] { return *other ? (*other)() : run(*o, *verb); };
}

}  // namespace touchstone::cli
