// Requests of the harness to a fork server: the host process that has loaded a plug-in and forks workers from
// itself, at a fraction of the cost of loading the plug-in's libraries again. Fixed-size records over a Unix
// socket, one reply per request.
#pragma once

#include <array>
#include <cstdint>

namespace touchstone::fork_server {

enum class Op : std::int32_t {
  /// Carries three descriptors: questions, answers, standard error. Reply: pid, or -1. For native engines
  /// (oracles/host/serve.h) it names the engine, and `pid` is 1 if the worker may buffer its answers.
  fork = 1,
  poll = 2,  // has worker `pid` ended? Reply: 1 and its wait status, or 0
  wait = 3   // the same, but blocks until the worker has ended
};

struct Request {
  Op op;
  std::int32_t pid;
  std::array<char, 56> engine{};  // zero-terminated
};

struct Reply {
  std::int32_t value;
  std::int32_t status;
};

inline constexpr int descriptor_count = 3;

}  // namespace touchstone::fork_server
