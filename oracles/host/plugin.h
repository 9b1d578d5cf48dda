// Loading a plug-in and choosing one of its engines.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::host {

/// `file` may be "pipe:COMMAND", a command behind a pipe (pipe.h). Throws std::runtime_error with the reason
/// if the file is not a plug-in of this ABI. The library is never unloaded: engines may have threads and exit
/// handlers in it.
const ts_plugin& load_plugin(const std::string& file);

std::vector<std::string> cards_of(const ts_plugin& plugin);

/// Index of the engine whose card has this name; an empty name means the only engine. Throws
/// std::runtime_error.
int choose_engine(const std::vector<std::string>& cards, const std::string& name);

}  // namespace touchstone::host
