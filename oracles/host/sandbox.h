// What a plug-in, and the command of a pipe, can do to the machine and to the user's files: read them,
// compute, and write into a scratch directory. Each part is in force where the kernel grants it; sandbox()
// says which are.
#pragma once

#include <cstdint>
#include <string>

#include "oracles/host/supervisor.h"

namespace touchstone::host {

struct SandboxWish {
  std::string scratch;             // a directory of the harness's making, the only place to write to
  std::uint64_t memory_bytes = 0;  // resident memory that the harness lets the engine have
  bool is_command = false;         // a pipe's command: the user's working directory is its own
};

/// Forks (see supervisor.h) and returns in the child, confined, with what is in force in words.
struct Sandbox {
  std::string words;
  Apart apart;
};
Sandbox enter_sandbox(const SandboxWish& wish);

/// Its parts, for sandbox.cpp. Each says whether the kernel grants it.
bool limit_writing_by_landlock(const std::string& scratch);
bool forbid_sockets();

}  // namespace touchstone::host
