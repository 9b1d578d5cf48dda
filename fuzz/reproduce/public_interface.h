// Reproducers that reach an engine through the interfaces that users connect engines by.
#pragma once

#include <string>

#include "fuzz/reproduce/reproducer.h"
#include "oracles/reproducer/engine_source.h"

namespace touchstone::fuzz {

/// Loads the plug-in, and asks it about the scene as it is.
EngineSource plugin_source(const EngineQuestion& q, const PluginFile& plugin);

/// The scene and the question, a line each. Throws InputError if JSON cannot represent a number.
std::string pipe_lines(const EngineQuestion& q, const std::string& expected);

}  // namespace touchstone::fuzz
