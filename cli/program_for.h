// The program that shows a finding, whatever kind of engine it is about.
#pragma once

#include <string>

#include "reports/record/result.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::cli {

/// Whether a program against its own API can be written for the engine with this name on its card.
bool has_program(const std::string& name);

/// `name`: the engine as the command line gives it. For engines with a writer of their own, a program against
/// their API, compiled against the user's own build where the engine is one; for other plug-ins, one that loads
/// the shared object; for a command behind a pipe, its lines. Throws InputError if there is none.
std::string program_for(const fuzz::Finding& finding, const EngineCard& card, const std::string& name);

}  // namespace touchstone::cli
