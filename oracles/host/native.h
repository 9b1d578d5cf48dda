// Serves engines of this build (oracles/abi/native_engine.h): without the C ABI, and with answers in batches.
#pragma once

#include <string>

#include "oracles/abi/native_engine.h"
#include "oracles/host/fork_server.h"

namespace touchstone::host {

/// The factory of the file's engines if it is a library of native engines, or null.
MakeNativeEngine* load_native(const std::string& file);

/// Reads questions and writes answers until the harness closes its end. A worker that buffers answers writes
/// those of a few milliseconds at once, at a fraction of the cost of separate writes; when it dies, the
/// harness repeats the unanswered questions. Any other worker writes each answer immediately: a crash loses
/// only the running question.
void serve_native(NativeEngine& engine, const WorkerStreams& streams);

}  // namespace touchstone::host
