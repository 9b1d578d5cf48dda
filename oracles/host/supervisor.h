// Nothing that a plug-in starts outlives it: the process that loads it has a supervisor, and where the kernel
// gives one, a PID namespace of its own.
#pragma once

#include <string>

namespace touchstone::host {

struct Apart {
  bool pid_namespace = false;
  bool user_namespace = false;
  bool may_mount = false;  // the process has the capabilities for mounts of its own
};

/// Forks. Returns in the child, which is to load the plug-in. The parent waits for its end, ends what it left
/// behind, removes the directory `scratch`, and ends in the same way; it does so too on SIGTERM, which the
/// kernel sends when the harness dies.
Apart supervise(const std::string& scratch);

/// Ends every process below this one and in its namespace, daemons included, and waits for that.
void end_others(const Apart& apart);

}  // namespace touchstone::host
