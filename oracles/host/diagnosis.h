// What makes errors of a worker visible: the call stack of a crash, and a chosen content of fresh memory.
#pragma once

#include <cstdint>

namespace touchstone::host {

// Reports where a worker was when a signal ended it: printed by the dying process, read by the harness
// (oracles/abi/last_words.h).

/// Call once, before any worker is forked: the first backtrace of a process allocates and loads a library.
void prepare_crash_reports();

/// Call in a worker: a fatal signal then first writes the call stack to standard error, as one line of
/// modules, offsets and names, which do not depend on where the modules were loaded. The process still dies
/// of that signal.
void report_crashes();

// Controls the content of uninitialised memory that an engine sees: normally always the same, so that the
// same question gets the same answer; or something else, so that answers that depend on it are detected.

/// From now on malloc returns memory filled with `byte`. Works with glibc without its thread caches, which is
/// how the harness starts this process; otherwise it has no effect.
void fill_new_memory(std::uint8_t byte);

/// Fills the part of the stack that the next call will use.
void fill_free_stack(std::uint8_t byte);

}  // namespace touchstone::host
