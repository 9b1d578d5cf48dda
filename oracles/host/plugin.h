// A loaded plug-in, and one engine of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::host {

/// "pipe:COMMAND" is a command behind a pipe (pipe.h). Throws std::runtime_error with the reason when the file is no plug-in of this ABI. Stays loaded for ever:
/// engines may have threads and exit handlers in it.
const ts_plugin& load_plugin(const std::string& file);

std::vector<std::string> cards_of(const ts_plugin& plugin);

/// Index of the engine whose card has this name; an empty name means the only engine. Throws
/// std::runtime_error.
int choose_engine(const std::vector<std::string>& cards, const std::string& name);

}  // namespace touchstone::host
