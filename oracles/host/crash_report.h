// Where a worker was when a signal ended it: printed by the dying process, read by the harness
// (oracles/abi/last_words.h).
#pragma once

namespace touchstone::host {

/// Once, before any worker is forked: the first backtrace of a process allocates and loads a library.
void prepare_crash_reports();

/// In a worker: a signal that kills the process first writes its call stack to standard error, as one line of
/// modules, offsets and names, which are the same wherever the modules were loaded. The process still dies of
/// that signal.
void report_crashes();

}  // namespace touchstone::host
