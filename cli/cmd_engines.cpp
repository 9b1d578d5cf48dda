#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/npm_engines.h"
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
  if (!which.empty()) {
    for (const auto& name : engine_names(which)) show(name);
  } else {
    for (const EngineRow& row : engine_catalog()) {
      if (is_present(row))
        show(std::string(row.name));
      else if (json)
        j.push_back({{"name", row.name}, {"absent", true}});
      else
        fmt::print("{:<24} absent: its library was not found\n    {} was not built\n", row.name, row.library);
    }
    for (const NpmRow& row : npm_catalog()) {
      if (is_installed(row))
        show(std::string(row.name));
      else if (json)
        j.push_back({{"name", row.name}, {"absent", true}});
      else
        fmt::print("{:<24} absent: engines --install {} gets it from npm\n    {}\n", row.name, row.name,
                   row.line);
    }
  }
  if (json) fmt::print("{}\n", j.dump(1));
  if (!json) print_sandboxes(sandboxes);
  return exit_clean;
}

// Returns 0 if every probe is answered rightly or declared unsupported, 3 if nothing is answered.
int check(const std::string& which, const WorkerLimits& limits) {
  const auto names = engine_names(which);
  if (names.size() != 1) throw InputError("--check " + which, "names more than one engine");
  const EnginePtr engine = make_engine(names[0], limits);
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
  app.add_option("--install", *wanted,
                 "engines to install from npm, separated by commas: jolt, jolt-tuned, rapier")
      ->delimiter(',')
      ->allow_extra_args(false);
  auto limits = std::make_shared<WorkerLimits>();
  add_no_sandbox(app, *limits);
  return [which, json, checked, wanted, limits] {
    if (!wanted->empty()) return install_npm_engines(*wanted);
    return checked->empty() ? list(*which, *json, *limits) : check(*checked, *limits);
  };
}

}  // namespace touchstone::cli
