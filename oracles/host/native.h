// Engines of this build (oracles/abi/native_engine.h): no C ABI, and answers in batches.
#pragma once

#include <string>

#include "oracles/abi/native_engine.h"
#include "oracles/host/fork_server.h"

namespace touchstone::host {

/// What makes the engines of the file when it is a library of native engines, or null.
MakeNativeEngine* load_native(const std::string& file);

/// Questions in, answers out, until the harness closes its end. A worker that keeps answers back writes those
/// of a few milliseconds at once, for a fraction of the cost of writing each; when it dies, the harness asks
/// again for what it did not get. Any other writes each answer at once: a crash loses the running question
/// and nothing else.
void serve_native(NativeEngine& engine, const WorkerStreams& streams);

}  // namespace touchstone::host
