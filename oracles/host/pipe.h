// An engine in any language behind a pipe (oracles/abi/pipe_protocol.md), seen as a plug-in: the worker
// starts the command and translates the C ABI into its lines.
#pragma once

#include <string>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::host {

inline constexpr const char* pipe_prefix = "pipe:";

/// Starts the command once to read its card. Throws std::runtime_error with the reason if it cannot be
/// started or its first line is not a card.
const ts_plugin& load_pipe(const std::string& command);

}  // namespace touchstone::host
