// The fork server: the host process after loading its plug-in, which forks workers on request and reaps them.
#pragma once

#include <functional>
#include <string>

#include "oracles/host/sandbox.h"

namespace touchstone::host {

struct WorkerStreams {
  int questions, answers;
  bool buffers_answers = false;  // it may write several answers at once (serve_native)
  std::string engine{};          // for a library of native engines
};

struct ForkServer {
  int control_fd;
  Apart apart;
  std::string scratch;  // each worker gets a directory in it, removed with the worker; empty: none
  bool keeps_working_directory = false;  // the workers keep the user's working directory
  bool is_shared = false;  // several workers at a time, which write no files and start no processes
};

/// Duplicates the open file to a descriptor high enough that no printf and no loop over small descriptors
/// reaches it.
int duplicate_high(int fd);

/// Sends one byte on the socket `fd`: the kernel attaches this process's pid as the harness sees it.
void announce_pid(int fd);

/// Serves requests (oracles/abi/fork_server_protocol.h) until the harness closes its end; never returns.
/// `work` runs in each forked worker, whose standard streams have been protected. When a worker ends, the
/// processes and the directory that it leaves behind are removed.
[[noreturn]] void run_fork_server(const ForkServer& fork_server,
                                  const std::function<void(WorkerStreams)>& work);

}  // namespace touchstone::host
