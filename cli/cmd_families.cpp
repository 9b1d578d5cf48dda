// touchstone families: the families of random cases and, with --coverage, what a number of them reach.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "core/base/input_error.h"
#include "fuzz/coverage/coverage.h"
#include "reports/record/observation_json.h"
#include "reports/text/text.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/random/family.h"

namespace touchstone::cli {

namespace {

struct FamiliesOptions {
  bool json = false, coverage = false;
  std::uint64_t cases = 2000, seed = 1;
  std::string family, engines;
  WorkerLimits limits;
};

void print_text() {
  for (const fuzz::Family& f : fuzz::families()) fmt::print("{:<15} {}\n", f.name, f.line);
  fmt::print("\nFeatures of the default mix, each in at least one case out of N:\n");
  for (const fuzz::Regime& r : fuzz::regimes()) fmt::print("{:<15} {:>4} {}\n", r.name, r.one_in, r.line);
}

void print_json() {
  fuzz::Json families = fuzz::Json::array(), regimes = fuzz::Json::array();
  for (const fuzz::Family& f : fuzz::families())
    families.push_back({{"name", f.name}, {"line", f.line}, {"weight", f.weight}});
  for (const fuzz::Regime& r : fuzz::regimes())
    regimes.push_back({{"name", r.name}, {"line", r.line}, {"one_in", r.one_in}});
  fmt::print("{}\n", json_text(fuzz::Json{{"families", families}, {"regimes", regimes}}, 1));
}

// One batch at a time, so that an engine that dies loses little.
fuzz::Coverage covered(const FamiliesOptions& o) {
  constexpr std::uint64_t batch = 32;
  const auto engines =
      o.engines.empty() ? std::vector<EnginePtr>() : make_engines(engine_names(o.engines), o.limits);
  fuzz::Coverage coverage;
  for (std::uint64_t first = 0; first < o.cases && !interrupted; first += batch) {
    std::vector<Case> cases;
    for (std::uint64_t i = first; i < std::min(first + batch, o.cases); ++i)
      cases.push_back(fuzz::make_case(o.seed, i, o.family));
    for (const Case& c : cases) coverage.add(c, true);
    for (const EnginePtr& e : engines) {
      const auto answers = e->run(cases);
      for (std::size_t i = 0; i < cases.size(); ++i) coverage.add(e->card(), cases[i], answers[i]);
    }
  }
  return coverage;
}

std::string group_text(const fuzz::Coverage& c, const fuzz::CoverageGroup& g) {
  constexpr std::size_t columns = 78, indent = 2;
  std::string values;
  for (const std::string& value : g.values)
    values +=
        fmt::format("{}{}: {}", values.empty() ? "" : ", ", value, reports::grouped(c.count(g.name, value)));
  return fmt::format("{}: {}\n{}{}\n", g.name, g.line, std::string(indent, ' '),
                     reports::wrapped(values, columns - indent, indent));
}

void print_coverage_text(const fuzz::Coverage& c) {
  for (const fuzz::CoverageGroup& g : c.groups()) fmt::print("{}", group_text(c, g));
  const auto missed = c.missed();
  std::string names;
  for (const auto& [group, value] : missed)
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", group, value);
  fmt::print("\n{}\n",
             reports::wrapped(fmt::format("{} cases; never reached: {}", reports::grouped(c.cases()),
                                          names.empty() ? "nothing of the above" : names),
                              78, 2));
}

void print_coverage_json(const fuzz::Coverage& c) {
  fuzz::Json groups = fuzz::Json::object(), missed = fuzz::Json::array();
  for (const fuzz::CoverageGroup& g : c.groups())
    for (const std::string& value : g.values) groups[g.name][value] = c.count(g.name, value);
  for (const auto& [group, value] : c.missed()) missed.push_back({group, value});
  fmt::print("{}\n",
             json_text(fuzz::Json{{"cases", c.cases()}, {"groups", groups}, {"never_reached", missed}}, 1));
}

int run(const FamiliesOptions& o) {
  if (!o.coverage) {
    if (!o.engines.empty() || !o.family.empty())
      throw InputError(o.engines.empty() ? "--family" : "--engines", "needs --coverage");
    o.json ? print_json() : print_text();
    return exit_clean;
  }
  catch_stop_signals();
  const fuzz::Coverage c = covered(o);
  o.json ? print_coverage_json(c) : print_coverage_text(c);
  if (!interrupted) return exit_clean;
  fmt::print(stderr, "interrupted after {} of {} cases\n", c.cases(), o.cases);
  return exit_failed;
}

}  // namespace

Run declare_families(CLI::App& app) {
  auto o = std::make_shared<FamiliesOptions>();
  app.add_flag(
      "--coverage", o->coverage,
      "make cases and count what they reach: shapes, sizes, orders, motions, regimes of contact, the "
      "core's arithmetic, and what engines make of them");
  app.add_option("--cases", o->cases, "number of cases to count")->check(a_count())->capture_default_str();
  app.add_option("--seed", o->seed, "same seed, same cases")->capture_default_str();
  app.add_option("--family", o->family, "only these families: a,b,… (default: the mix of a campaign)");
  app.add_option("--engines", o->engines, "also put the cases to these engines and count their outcomes");
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
