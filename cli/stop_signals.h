// Lets a long run keep its results when it is stopped from the keyboard, by kill, or by closing the terminal.
#pragma once

#include <atomic>

namespace touchstone::cli {

/// Set by SIGINT, SIGTERM and SIGHUP.
extern std::atomic<bool> interrupted;

/// Installs the handlers. SIGHUP stays ignored if it already is (nohup).
void catch_stop_signals();

}  // namespace touchstone::cli
