#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/npm_engines.h"
#include "cli/optional_engines.h"
#include "cli/own_engines.h"
#include "core/base/input_error.h"
#include "fuzz/certify/conformance.h"
#include "reports/record/observation_json.h"
#include "reports/text/text.h"
#include "scenarios/codec/value_codec.h"

namespace touchstone::cli {
namespace {

// What a card states only if it applies.
std::vector<std::string> further_claims(const EngineCard& c) {
  std::vector<std::string> lines;
  if (!c.shapes.empty()) {
    std::string names;
    for (const ShapeKind k : c.shapes) names.append(names.empty() ? "" : ", ").append(type_name(k));
    lines.push_back("takes " + names);
  }
  for (const KindRoundoff& r : c.unit_roundoffs)
    lines.push_back(fmt::format("unit roundoff of {}: {:.3g}", type_name(r.kind), r.unit_roundoff));
  if (c.contact_offset > 0)
    lines.push_back(fmt::format("reports contacts up to {:g} apart", c.contact_offset));
  if (c.sweep_skin > 0)
    lines.push_back(fmt::format("sweeps stop up to {:g} before the contact", c.sweep_skin));
  if (c.separate_triangles) lines.emplace_back("takes the triangles of a mesh apart");
  for (const DepthBias& d : c.depth_biases)
    lines.push_back(fmt::format("{} and {}: its normal may need {:g} % more depth than the least",
                                type_name(d.a), type_name(d.b), 100 * d.share));
  if (c.times_include_pipe) lines.emplace_back("times include the pipe: it states none of its own");
  return lines;
}

void print_card(const EngineCard& c) {
  fmt::print("{:<24} {} {}\n", c.name, c.library, c.version);
  if (!c.settings.empty()) fmt::print("    {}\n", reports::wrapped(c.settings, 76, 4));
  fmt::print("    tolerance {:g}·{:.3g}·L plus each answer's claim", c.tau_factor, c.unit_roundoff);
  for (const std::string& line : further_claims(c)) fmt::print("\n    {}", reports::wrapped(line, 76, 4));
  if (!c.source.empty()) fmt::print("\n    {}", reports::wrapped("(" + c.source + ")", 76, 4));
  fmt::print("\n");
}

std::string sandbox_of(const Engine& e) {
  const auto* remote = dynamic_cast<const RemoteEngine*>(&e);
  return remote ? remote->sandbox() : "";
}

void print_sandboxes(const std::set<std::string>& sandboxes) {
  for (const std::string& words : sandboxes)
    fmt::print("{}\n", reports::wrapped("sandbox for plug-ins and commands: " + words, 76, 4));
}

int list(const std::string& which, bool json, const WorkerLimits& limits) {
  fuzz::Json j = fuzz::Json::array();
  std::set<std::string> sandboxes;
  const auto show = [&](const std::string& name) {
    const EnginePtr e = make_engine(name, limits);
    const std::string sandbox = sandbox_of(*e);
    if (!sandbox.empty()) sandboxes.insert(sandbox);
    if (!json) return print_card(e->card());
    j.push_back(fuzz::Json::parse(to_json_text(e->card())));
    if (!sandbox.empty()) j.back()["sandbox"] = sandbox;
  };
  const auto show_absent = [&](std::string_view folder) {
    if (json)
      j.push_back({{"name", folder}, {"absent", true}});
    else
      fmt::print("{:<24} absent: its library was not found\n    oracles/{} was not built\n", folder, folder);
  };
  const auto show_optional = [&](const std::string& adapter) {
    if (json)
      j.push_back({{"name", adapter}, {"absent", true}});
    else
      fmt::print(
          "{:<24} absent: engines --install {} compiles it\n    {}\n", adapter, adapter,
          reports::wrapped(fmt::format("against Debian's {}", fmt::join(debian_packages_of(adapter), ", ")),
                           76, 4));
  };
  const auto show_own = [&](const std::string& own) {
    try {
      for (const PluginEngine& e : engines_of(own_engine(own)))
        if (e.kind == EngineKind::pairs) show(e.card.name);
    } catch (const InputError& e) {
      if (json)
        j.push_back({{"name", own}, {"absent", true}, {"reason", e.what()}});
      else
        fmt::print("{:<24} unusable: {}\n", own, reports::wrapped(e.what(), 76, 4));
    }
  };
  // By name only: starting dozens of them takes as many seconds.
  const auto list_releases = [&] {
    std::map<std::string, std::vector<std::string>> releases;
    for (const NpmEngine& e : installed_releases()) {
      if (json)
        j.push_back({{"name", e.name()}, {"release_of", e.row->name}, {"version", e.version()}});
      else
        releases[std::string(e.row->name)].push_back(e.version());
    }
    for (const auto& [engine, versions] : releases)
      fmt::print("{:<24} {}\n", engine + "@",
                 reports::wrapped(fmt::format("installed releases: {}", fmt::join(versions, ", ")), 54, 25));
  };
  if (!which.empty()) {
    for (const auto& name : engine_names(which)) show(name);
  } else {
    for (const std::string& name : present_engines(EngineKind::pairs)) show(name);
    for (const std::string_view folder : engine_folders())
      if (!is_present(folder)) show_absent(folder);
    for (const NpmRow& row : npm_catalog()) {
      if (is_installed({&row, ""}))
        show(std::string(row.name));
      else if (json)
        j.push_back({{"name", row.name}, {"absent", true}});
      else
        fmt::print("{:<24} absent: engines --install {} gets it from npm\n    {}\n", row.name, row.name,
                   row.line);
    }
    list_releases();
    const std::vector<std::string> registered = own_names();
    for (const std::string& adapter : optional_adapters())
      if (!std::ranges::binary_search(registered, adapter)) show_optional(adapter);
    for (const std::string& own : registered) show_own(own);
  }
  if (json) fmt::print("{}\n", j.dump(1));
  if (!json) print_sandboxes(sandboxes);
  return exit_clean;
}

// Returns 0 if every probe is answered rightly or declared unsupported, 3 if nothing is answered.
int check(const std::string& which, const WorkerLimits& limits) {
  const EnginePtr engine = make_engine(engine_name(which), limits);
  print_card(engine->card());
  int right = 0, wrong = 0;
  for (const fuzz::Remark& r : fuzz::conformance(*engine)) {
    fmt::print("{:<12} {}\n", r.verdict, r.probe);
    if (r.verdict == "wrong") fmt::print("             {}\n", reports::wrapped(r.words, 66, 13));
    right += r.verdict == "right";
    wrong += r.verdict == "wrong";
  }
  fmt::print("{}: {} right, {} wrong\n", engine->card().name, right, wrong);
  if (wrong > 0) return exit_wrong;
  return right > 0 ? exit_clean : exit_failed;
}

// The options that compile and register, or remove.
struct OwnOptions {
  OwnBuild build;
  std::string rebuilt, removed;
};

void add_own_options(CLI::App& app, OwnOptions& o) {
  auto* build = app.add_option("--build", o.build.adapter,
                               "compile this adapter against your own build of its library, and register it");
  app.add_option("--prefix", o.build.prefix, "where that library is installed (default: the system's)")
      ->needs(build);
  app.add_option("--name", o.build.name, "name to register it under (default: the adapter's, or ADAPTER-own)")
      ->needs(build);
  auto* rebuild =
      app.add_option("--rebuild", o.rebuilt, "compile the adapter of this registered engine again");
  app.add_option("--rebuild-with", o.build.command,
                 "with --build or --rebuild: a command of the shell to run first; it is never stored");
  auto* remove = app.add_option("--remove", o.removed, "remove this registered engine");
  build->excludes(rebuild)->excludes(remove);
  rebuild->excludes(remove);
}

// True if one of them was given.
bool is_about_own(const OwnOptions& o) {
  if (!o.build.command.empty() && o.build.adapter.empty() && o.rebuilt.empty())
    throw InputError("--rebuild-with", "needs --build or --rebuild");
  return !o.build.adapter.empty() || !o.rebuilt.empty() || !o.removed.empty();
}

int run_own(const OwnOptions& o) {
  if (!o.removed.empty()) return remove_own_engine(o.removed);
  return o.rebuilt.empty() ? build_own_engine(o.build) : rebuild_own_engine(o.rebuilt, o.build.command);
}

// Engines from npm and those compiled against Debian's libraries have an installer each.
int install(const std::vector<std::string>& names) {
  std::vector<std::string> npm, compiled;
  for (const std::string& name : names) (is_of_npm(name) ? npm : compiled).push_back(name);
  const int code = npm.empty() ? exit_clean : install_npm_engines(npm);
  return code != exit_clean || compiled.empty() ? code : install_optional_engines(compiled);
}

// For the launcher, which installs them. An unknown name needs none: --install refuses it.
int print_packages(const std::vector<std::string>& names) {
  std::set<std::string> packages;
  for (const std::string& name : names) {
    if (is_of_npm(name)) packages.insert({"nodejs", "npm"});
    if (const std::string adapter = optional_adapter_of(name); !is_of_npm(name) && !adapter.empty())
      for (const std::string& package : debian_packages_of(adapter)) packages.insert(package);
  }
  fmt::print("{}\n", fmt::join(packages, " "));
  return exit_clean;
}

}  // namespace

Run declare_engines(CLI::App& app) {
  auto which = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  app.add_option("engines", *which, "only these: names or paths of plug-ins, separated by commas");
  app.add_flag("--json", *json, "one JSON document");
  auto checked = std::make_shared<std::string>();
  app.add_option("--check", *checked,
                 "test whether an engine (./libmine.so, pipe:COMMAND) uses the interface correctly");
  auto wanted = std::make_shared<std::vector<std::string>>();
  app.add_option(
         "--install", *wanted,
         "engines to install, separated by commas: from npm (jolt, or one release, jolt@1.1.0, or the newest "
         "that begins so, jolt@0.29), or compiled against Debian's libraries; the list of engines names them")
      ->delimiter(',')
      ->allow_extra_args(false);
  auto packages = std::make_shared<bool>(false);
  app.add_flag("--debian-packages", *packages, "print the Debian packages that --install needs, and stop");
  auto own = std::make_shared<OwnOptions>();
  add_own_options(app, *own);
  auto limits = std::make_shared<WorkerLimits>();
  add_no_sandbox(app, *limits);
  return [which, json, checked, wanted, packages, own, limits] {
    if (is_about_own(*own)) return run_own(*own);
    if (*packages) return print_packages(*wanted);
    if (!wanted->empty()) return install(*wanted);
    return checked->empty() ? list(*which, *json, *limits) : check(*checked, *limits);
  };
}

}  // namespace touchstone::cli
