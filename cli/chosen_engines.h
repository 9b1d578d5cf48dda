// Which engines a command queries, and which of them is the subject, the one its exit code is about. All
// commands follow the same rule.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/engine_catalog.h"
#include "fuzz/certify/certify.h"
#include "oracles/client/remote_engine.h"

namespace touchstone::cli {

struct EngineChoice {
  std::string engines = "all", subject;  // as given; an empty subject is chosen by the rule below
};
/// --engines, by the given names of the option, and --subject.
void add_engine_choice(CLI::App& app, EngineChoice& to, const std::string& names = "--engines");

struct ChosenEngines {
  std::vector<std::string> names;  // as make_engine takes them; the subject is among them
  std::string subject;             // the name on its card, which results use
  std::vector<ShapeKind> shapes;   // the kinds that the subject's card lists; empty: it lists none
};
/// The subject given may be a name from --engines, the name on an engine's card, or a further engine, which
/// is then queried too. If none is given, it is the only engine queried, else the core if the core is
/// queried. Throws InputError when there is no such engine, or when several engines without the core leave it
/// open.
ChosenEngines chosen_engines(const EngineChoice& choice, const WorkerLimits& limits);

/// Throws InputError when two of them have the same name: their results could not be told apart.
std::vector<EnginePtr> make_engines(const std::vector<std::string>& names, const WorkerLimits& limits);

/// Throws InputError with suggestions unless `subject` is one of `known` (names on cards). `what` describes
/// them: "the chart's engines".
void require_subject(const std::string& subject, const std::vector<std::string>& known,
                     const std::string& what);

/// Prints the last line of every command that judges: which engine the exit code is about, and why. It goes
/// to stderr when stdout holds JSON. Returns the code.
int print_verdict(int code, const std::string& subject, const std::string& why, bool json = false);

// The subject of `certify`: a broad phase of the core or of an oracle, any engine in the catalogue, a
// plug-in, or a command behind a pipe.

/// Multiplies the time allowed per question.
WorkerLimits scaled_limits(WorkerLimits limits, double times);

/// Throws InputError with place and reason when there is no such subject. `sweeps`: the user states that it
/// also answers swept_candidates, as the core does.
fuzz::Subject broad_subject(const std::string& name, const WorkerLimits& limits, bool sweeps);

}  // namespace touchstone::cli
