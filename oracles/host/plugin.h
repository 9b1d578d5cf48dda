// Loading engines: from a plug-in, from a library of native engines, or by a command behind a pipe.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "oracles/abi/native_engine.h"
#include "oracles/abi/touchstone_engine.h"

namespace touchstone::host {

/// `file` may be "pipe:COMMAND", a command behind a pipe. Throws std::runtime_error with the reason
/// if the file is not a plug-in of this ABI. The library is never unloaded: engines may have threads and exit
/// handlers in it.
const ts_plugin& load_plugin(const std::string& file);

std::vector<std::string> cards_of(const ts_plugin& plugin);

/// Index of the engine whose card has this name; an empty name means the only engine. Throws
/// std::runtime_error.
int choose_engine(const std::vector<std::string>& cards, const std::string& name);

/// `library` as returned by dlopen. Throws std::runtime_error if it says that it was built from other sources
/// than this host (oracles/abi/source_id.h).
void require_same_sources(void* library);

/// The factory of the file's engines if it is a library of native engines (oracles/abi/native_engine.h), or
/// null. Throws like require_same_sources.
MakeNativeEngine* load_native(const std::string& file);

// An engine in any language behind a pipe (oracles/abi/pipe_protocol.md), seen as a plug-in: the worker
// starts the command and translates the C ABI into its lines.

inline constexpr const char* pipe_prefix = "pipe:";

/// Starts the command once to read its card. Throws std::runtime_error with the reason if it cannot be
/// started or its first line is not a card.
const ts_plugin& load_pipe(const std::string& command);

}  // namespace touchstone::host
