// Confines a plug-in, or the command of a pipe: it may read the user's files, compute, and write into a
// scratch directory. Each restriction is in force if the kernel grants it; sandbox() reports which ones are.
#pragma once

#include <cstdint>
#include <string>

#include "oracles/host/supervisor.h"

namespace touchstone::host {

struct SandboxWish {
  std::string scratch;             // a directory created by the harness, the only writable place
  std::uint64_t memory_bytes = 0;  // resident memory that the engine may use
  bool is_command = false;         // a pipe's command: keeps the user's working directory
};

/// Forks (see supervisor.h) and returns in the child, confined, with a description of what is in force.
struct Sandbox {
  std::string description;
  Apart apart;
};
Sandbox enter_sandbox(const SandboxWish& wish);

/// Parts of enter_sandbox(). Each returns whether the kernel grants it.
bool limit_writing_by_landlock(const std::string& scratch);
bool forbid_sockets();

}  // namespace touchstone::host
