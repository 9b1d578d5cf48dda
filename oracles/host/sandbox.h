// Confines a plug-in, or the command of a pipe: it may read the user's files, compute, and write into a
// scratch directory. Each restriction is in force if the kernel grants it; sandbox() reports which ones are.
#pragma once

#include <cstdint>
#include <string>

namespace touchstone::host {

// Ensures that nothing that a plug-in starts outlives it: the process that loads it has a supervisor and, if
// the kernel grants it, its own PID namespace.

struct Apart {
  bool pid_namespace = false;
  bool user_namespace = false;
  bool may_mount = false;  // the process has the capabilities for its own mounts
};

/// Forks and returns in the child, which then loads the plug-in. The parent waits until the child ends, ends
/// what it left behind, removes the directory `scratch`, and ends in the same way. It does so too on SIGTERM,
/// which the kernel sends when the harness dies.
Apart supervise(const std::string& scratch);

/// Ends every descendant of this process and every other process in its namespace, including daemons, and
/// waits until they are gone.
void end_others(const Apart& apart);

struct SandboxWish {
  std::string scratch;             // a directory created by the harness, the only writable place
  std::uint64_t memory_bytes = 0;  // resident memory that the engine may use
  bool is_command = false;         // a pipe's command: keeps the user's working directory
};

/// Forks (see supervise) and returns in the child, confined, with a description of what is in force.
struct Sandbox {
  std::string description;
  Apart apart;
};
Sandbox enter_sandbox(const SandboxWish& wish);

/// Parts of enter_sandbox(). Each returns whether the kernel grants it.
bool limit_writing_by_landlock(const std::string& scratch);
bool forbid_sockets();

}  // namespace touchstone::host
