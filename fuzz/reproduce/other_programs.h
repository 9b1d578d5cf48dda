// Reproducers other than C++ programs against an engine's own API: a JavaScript module that imports only the
// engine's package and runs under Node.js, and what reaches an engine through the interfaces that users
// connect engines by.
#pragma once

#include <string>

#include "fuzz/judge/truth.h"
#include "fuzz/reproduce/reproducer.h"
#include "oracles/reproducer/engine_source.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// `tau`: the tolerance of the check. Throws InputError if no program checks the fault.
std::string javascript_program(const Finding& finding, const EngineCard& card, const EngineQuestion& q,
                               const EngineSource& source, Truth& truth, double tau);

/// Loads the plug-in, and asks it about the scene as it is.
EngineSource plugin_source(const EngineQuestion& q, const PluginFile& plugin);

/// The scene and the question, a line each. Throws InputError if JSON cannot represent a number.
std::string pipe_lines(const EngineQuestion& q, const std::string& expected);

}  // namespace touchstone::fuzz
