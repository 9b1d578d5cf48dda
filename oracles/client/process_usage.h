// Resource usage of a process and its descendants, from /proc. Linux.
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace touchstone {

struct ProcessUsage {
  double cpu_seconds = 0;  // of the process and its ended children, to 10 ms
  std::uint64_t resident_bytes = 0;
  char state = '?';  // as in ps: R running, S sleeping, T stopped by a signal; '?': no such process
  int processes = 0;
  bool is_gone() const { return processes == 0; }
};

ProcessUsage usage_of(pid_t pid);

/// The sum over all descendants of `root` and, if `with_root`, `root` itself. The state is R if any of them
/// runs or waits for a disk, T if all are stopped, S otherwise. If the kernel does not list children, only
/// `root` is counted.
ProcessUsage usage_of_tree(pid_t root, bool with_root);

}  // namespace touchstone
