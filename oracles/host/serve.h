// Reads questions and writes answers until the harness closes its end.
#pragma once

#include <cstddef>
#include <string>

#include "oracles/abi/native_engine.h"
#include "oracles/abi/touchstone_engine.h"
#include "oracles/host/fork_server.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::host {

/// Writes all of `bytes` to `fd`; ends the process if the other end is closed.
void write_all(int fd, const char* bytes, std::size_t n);

/// Returns at the end of the input. A scene with a shape that the engine is not sent (engine_card.h) is not
/// loaded.
void serve(const ts_plugin& plugin, ts_engine* engine, const EngineCard& card, int questions_fd,
           int answers_fd);

// Serves engines of this build (oracles/abi/native_engine.h): without the C ABI, and with answers in batches.

/// Reads questions and writes answers until the harness closes its end. A worker that buffers answers writes
/// those of a few milliseconds at once, at a fraction of the cost of separate writes; when it dies, the
/// harness repeats the unanswered questions. Any other worker writes each answer immediately: a crash loses
/// only the running question.
void serve_native(NativeEngine& engine, const WorkerStreams& streams);

}  // namespace touchstone::host
