// The start of a conversation with a worker: spawn, read its hello, or say why there is none.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "oracles/abi/protocol.h"
#include "oracles/client/worker_limits.h"
#include "oracles/client/worker_process.h"

namespace touchstone {

/// How long a worker that has closed its answers is given to end by itself.
inline constexpr double death_wait_seconds = 2;

struct WorkerSession {
  std::shared_ptr<WorkerProcess> process;
  protocol::FrameReader frames;
  protocol::Hello hello;
};

/// A fork server for the plug-in, and its hello. `argument` follows the plug-in's path: an engine, "" or
/// "--cards". Throws InputError (place: the plug-in) when the process dies, exceeds a limit, or
/// says that the plug-in cannot be used.
WorkerSession start_fork_server(const std::filesystem::path& host, const std::filesystem::path& plugin,
                                const std::string& argument, const WorkerLimits& limits);

/// The fork server for a library of native engines (oracles/host/native.h), of which this process has one at
/// a time: with the last that uses it, it ends. Throws InputError as above.
std::shared_ptr<const WorkerSession> share_native_fork_server(const std::filesystem::path& host,
                                                              const std::filesystem::path& library,
                                                              const WorkerLimits& limits);

/// A worker of the fork server. Throws InputError as above.
WorkerSession start_worker(const WorkerSession& fork_server, const std::filesystem::path& plugin,
                           const WorkerLimits& limits, const WorkerProcess::Native* native = nullptr);

enum class ReadResult { some, nothing_yet, closed };
/// Reads what is there, up to a bound, into `frames`.
ReadResult read_available(int fd, protocol::FrameReader& frames);

}  // namespace touchstone
