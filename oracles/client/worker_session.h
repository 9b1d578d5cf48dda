// Starts a worker and reads its hello, or reports why that failed.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/base/input_error.h"
#include "oracles/abi/protocol.h"
#include "oracles/client/worker_limits.h"
#include "oracles/client/worker_process.h"

namespace touchstone {

/// How long a worker that has closed its answers is given to end by itself.
inline constexpr double death_wait_seconds = 2;

/// The host program was built from other sources than this program, perhaps while it ran, or a plug-in was
/// changed while it was in use. No engine is to blame.
class ProgramMismatch : public InputError {
 public:
  using InputError::InputError;
};

struct WorkerSession {
  std::shared_ptr<WorkerProcess> process;
  protocol::FrameReader frames;
  protocol::Hello hello;
};

/// Starts a fork server for the plug-in and reads its hello. `argument` follows the plug-in's path: an engine
/// name, "" or "--cards". Throws InputError (place: the plug-in) if the process dies, exceeds a limit, or
/// reports that the plug-in cannot be used; ProgramMismatch if the host was built from other sources.
WorkerSession start_fork_server(const std::filesystem::path& host, const std::filesystem::path& plugin,
                                const std::string& argument, const WorkerLimits& limits);

/// The shared fork server for a library of native engines (oracles/host/serve.h). This process has at most
/// one at a time; it ends with its last user. Throws InputError as above.
std::shared_ptr<const WorkerSession> share_native_fork_server(const std::filesystem::path& host,
                                                              const std::filesystem::path& library,
                                                              const WorkerLimits& limits);

/// Forks a worker of the fork server. Throws InputError as above.
WorkerSession start_worker(const WorkerSession& fork_server, const std::filesystem::path& plugin,
                           const WorkerLimits& limits, const WorkerProcess::Native* native = nullptr);

enum class ReadResult { some, nothing_yet, closed };
/// Reads what is available, up to a bound, into `frames`.
ReadResult read_available(int fd, protocol::FrameReader& frames);

}  // namespace touchstone
