// The start of a conversation with a worker: spawn, read its hello, or say why there is none.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "oracles/api/protocol.h"
#include "oracles/api/worker_process.h"

namespace touchstone {

struct WorkerSession {
  std::unique_ptr<WorkerProcess> process;
  protocol::FrameReader frames;
  protocol::Hello hello;
};

/// `arguments` follow the plug-in's path. Throws InputError (place: the plug-in) when the worker dies, is
/// silent for `wall_seconds`, or says that the plug-in cannot be used.
WorkerSession start_worker(const std::filesystem::path& host, const std::filesystem::path& plugin,
                           const std::vector<std::string>& arguments, double wall_seconds);

enum class ReadResult { some, nothing_yet, closed };
/// Reads what is there, up to a bound, into `frames`.
ReadResult read_available(int fd, protocol::FrameReader& frames);

}  // namespace touchstone
