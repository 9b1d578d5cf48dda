// Reports where a worker was when a signal ended it: printed by the dying process, read by the harness
// (oracles/abi/last_words.h).
#pragma once

namespace touchstone::host {

/// Call once, before any worker is forked: the first backtrace of a process allocates and loads a library.
void prepare_crash_reports();

/// Call in a worker: a fatal signal then first writes the call stack to standard error, as one line of
/// modules, offsets and names, which do not depend on where the modules were loaded. The process still dies
/// of that signal.
void report_crashes();

}  // namespace touchstone::host
