// Which engines a command asks, and which of them its exit code is about: the subject. One rule for all
// commands.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/engine_catalog.h"

namespace touchstone::cli {

struct EngineChoice {
  std::string engines = "all", subject;  // as given; an empty subject: by the rule
};
/// --engines and --subject.
void add_engine_choice(CLI::App& app, EngineChoice& to);

struct AskedEngines {
  std::vector<std::string> names;  // as make_engine takes them; the subject is among them
  std::string subject;             // the name on its card, by which results call it
};
/// The subject is the engine given: by the name under which it is asked, by the name on its card, or as
/// another engine, which is then asked too. Not given: the only engine asked, else the core, if it is asked.
/// Throws InputError: no such engine, or several and no core and no word which.
AskedEngines asked_engines(const EngineChoice& choice, const WorkerLimits& limits);

/// Throws InputError when two of them have one name: their results could not be told apart.
std::vector<EnginePtr> make_engines(const std::vector<std::string>& names, const WorkerLimits& limits);

/// The one of `known` (names on cards) that the exit code is about; throws InputError with suggestions.
/// `what` says what they are: "the chart's engines".
void require_subject(const std::string& subject, const std::vector<std::string>& known,
                     const std::string& what);

/// The last line of every command that judges: whom the exit code is about, and why. On stderr when stdout
/// holds JSON. Returns the code.
int say_verdict(int code, const std::string& subject, const std::string& why, bool json = false);

}  // namespace touchstone::cli
