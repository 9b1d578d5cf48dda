// The host process after loading its plug-in: forks workers on request and reaps them.
#pragma once

#include <functional>
#include <string>

#include "oracles/host/supervisor.h"

namespace touchstone::host {

struct WorkerStreams {
  int questions, answers;
  bool buffers_answers = false;  // it may write several answers at once (native.h)
  std::string engine{};          // of a library of native engines
};

struct ForkServer {
  int control_fd;
  Apart apart;
  std::string scratch;             // each worker gets a directory in it, gone with the worker; empty: none
  bool stays_where_it_is = false;  // the workers' working directory is the user's own
  bool is_shared = false;          // several workers at a time; what they run writes and starts nothing
};

/// The same open file as a descriptor that no loop over small numbers and no printf reaches.
int out_of_the_way(int fd);

/// Says one byte on `fd`, a socket: the kernel adds this process's number as the harness sees it.
void say_who(int fd);

/// Serves requests (oracles/abi/fork_server_protocol.h) until the harness closes its end; never returns.
/// `work` runs in each forked worker, whose standard streams have been protected. What a worker leaves
/// behind, its processes and its directory, ends with it.
[[noreturn]] void run_fork_server(const ForkServer& fork_server,
                                  const std::function<void(WorkerStreams)>& work);

}  // namespace touchstone::host
