// What a process and all that it has started use, by /proc. Linux.
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace touchstone {

struct ProcessUsage {
  double cpu_seconds = 0;  // of the process and of its children that have ended, to 10 ms
  std::uint64_t resident_bytes = 0;
  char state =
      '?';  // as ps prints it: R runs, S sleeps, T stopped by a signal; '?': there is no such process
  int processes = 0;
  bool is_gone() const { return processes == 0; }
};

ProcessUsage usage_of(pid_t pid);

/// The sum over all processes below `root` and, unless it is left out, `root`. Its state is R when one of
/// them runs or waits for a disk, T when all are stopped, S otherwise. Where the kernel does not list
/// children it is that of `root` alone.
ProcessUsage usage_of_tree(pid_t root, bool with_root);

}  // namespace touchstone
