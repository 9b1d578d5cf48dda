// Ensures that nothing that a plug-in starts outlives it: the process that loads it has a supervisor and, if
// the kernel grants it, its own PID namespace.
#pragma once

#include <string>

namespace touchstone::host {

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

}  // namespace touchstone::host
