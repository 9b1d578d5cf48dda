// How much an engine may take of the machine and of the harness's patience.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <string>

namespace touchstone {

/// CPU time is what the watchdog goes by, so that a loaded machine does not turn answers into time-outs. Wall
/// time only catches an engine that waits: for a short time if nothing of it uses the CPU, for a longer one
/// if its own children or a disk do the work.
struct WorkerLimits {
  double query_cpu_seconds = 1;
  /// A query ends after this many times query_cpu_seconds: the speed of a machine varies, and an answer that
  /// comes in between is judged like any other, and counted as slow.
  double patience = 4;
  double load_cpu_seconds = 10;   // taking a scene: hierarchies of large meshes are built here
  double start_cpu_seconds = 20;  // loading the plug-in and making its engine, its children included
  double blocked_seconds = 5;     // without any use of the CPU
  double wall_seconds = 80;       // without any progress; what works is stopped by its CPU time before
  double start_wall_seconds = 60;
  std::uint64_t resident_bytes = std::uint64_t{2} << 30;  // of the worker and all that it started
  bool sandbox = true;
  /// This program (Valgrind) runs the worker, which ends at its first access to memory that is not its own.
  /// It is some thirty times slower, and has no sandbox.
  std::string memcheck = {};
  /// Set by whoever wants all engines to stop: they then throw Stopped, whatever they wait for.
  const std::atomic<bool>* stop = nullptr;
};

struct Stopped final : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

inline void throw_if_stopped(const WorkerLimits& limits) {
  if (limits.stop && *limits.stop) throw Stopped();
}

}  // namespace touchstone
