// Limits on the resources and the time that an engine may use.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

namespace touchstone {

/// Clocks count nanoseconds, limits are in seconds.
inline constexpr double seconds_per_ns = 1e-9;

/// The watchdog measures CPU time, so that a loaded machine does not turn answers into time-outs. Wall time
/// only catches an engine that waits: the limit is short if none of its processes uses the CPU, and longer if
/// its children or a disk do the work.
struct WorkerLimits {
  double query_cpu_seconds = 1;
  /// A query is ended after this many times query_cpu_seconds, because the speed of a machine varies. An
  /// answer that arrives in between is judged like any other, and counted as slow.
  double patience = 4;
  double load_cpu_seconds = 10;   // loading a scene: hierarchies of large meshes are built here
  double start_cpu_seconds = 20;  // loading the plug-in and creating its engine, including its children
  double blocked_seconds = 5;     // without any use of the CPU
  double wall_seconds = 80;       // without progress; a busy engine reaches its CPU limit first
  double start_wall_seconds = 60;
  std::uint64_t resident_bytes = std::uint64_t{2} << 30;  // of the worker and its descendants
  bool sandbox = true;
  /// If not empty: the program (Valgrind) that runs the worker, which ends at its first invalid memory
  /// access. About thirty times slower, and without a sandbox.
  std::string memcheck = {};
  /// If not empty: the program that runs the worker, with its arguments: an emulator of the machine that the
  /// worker was built for. Without a sandbox.
  std::vector<std::string> run_with = {};
  /// Set to stop all engines: they then throw Stopped, whatever they are waiting for.
  const std::atomic<bool>* stop = nullptr;
};

struct Stopped final : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

inline void throw_if_stopped(const WorkerLimits& limits) {
  if (limits.stop && *limits.stop) throw Stopped();
}

}  // namespace touchstone
