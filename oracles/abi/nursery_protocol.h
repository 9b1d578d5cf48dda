// What the harness asks of a nursery: the host process that has loaded a plug-in and forks workers from
// itself, which costs a fraction of loading the plug-in's libraries again. Fixed-size records over a Unix
// socket, one reply a request.
#pragma once

#include <array>
#include <cstdint>

namespace touchstone::nursery {

enum class Op : std::int32_t {
  /// Comes with three descriptors: questions, answers, standard error. Reply: pid, or -1. Of a library of native
  /// engines (oracles/host/native.h) it names the engine; `pid` is 1 if the worker may keep answers back.
  fork = 1,
  poll = 2,  // has worker `pid` ended? Reply: 1 and its wait status, or 0
  wait = 3   // the same, after waiting for its end
};

struct Request {
  Op op;
  std::int32_t pid;
  std::array<char, 56> engine{};  // ends with a zero
};

struct Reply {
  std::int32_t value;
  std::int32_t status;
};

inline constexpr int descriptor_count = 3;

}  // namespace touchstone::nursery
