// What is done is kept when somebody ends a long run: from the keyboard, by kill, by closing the terminal.
#pragma once

#include <atomic>

namespace touchstone::cli {

/// Set by SIGINT, SIGTERM and SIGHUP once they are caught.
extern std::atomic<bool> interrupted;

/// SIGHUP stays ignored where it is ignored already: by nohup.
void catch_stop_signals();

}  // namespace touchstone::cli
