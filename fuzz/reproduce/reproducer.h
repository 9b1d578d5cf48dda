// Turns a finding into one file, C++ or (for engines from npm) JavaScript, that uses only the engine's own
// API and nothing of this project (of a plug-in or a command behind a pipe: its public interface): for the
// engine's developers, and for anyone who doubts the adapter. The program prints the engine's answer and the
// certain result, and exits with 1 while the answer is wrong.
#pragma once

#include <string>
#include <string_view>

#include "reports/record/result.h"

namespace touchstone::fuzz {

/// A plug-in as the command line names it.
struct PluginFile {
  std::string library;  // path of the shared object
  std::string engine;   // the name on its card
  std::string include;  // the directory that contains oracles/abi/touchstone_engine.h
};

/// True if the engine's folder has a writer for it (oracles/reproducer/engine_source.h).
bool has_reproducer(std::string_view engine);

/// Returns the program. `finding` must carry its evidence, as returned by findings_of; `card` is the
/// engine's. Throws InputError with the reason when the engine is not supported or its API lacks a shape.
std::string reproducer(const Finding& finding, const EngineCard& card);

/// The same for any plug-in: the program loads the shared object through the public header.
std::string plugin_reproducer(const Finding& finding, const EngineCard& card, const PluginFile& plugin);

/// For a command behind a pipe (oracles/abi/pipe_protocol.md): the lines that put the question to it, the
/// last one with the certain result as "expected". Throws InputError as above, and if a number is not finite.
std::string pipe_reproducer(const Finding& finding, const EngineCard& card);

}  // namespace touchstone::fuzz
