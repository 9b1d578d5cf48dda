// Limits a worker's CPU time, wall time and memory since its last progress.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "core/base/outcome.h"
#include "oracles/client/process_usage.h"
#include "oracles/client/worker_limits.h"
#include "oracles/client/worker_process.h"

namespace touchstone {

class Watchdog {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Phase { starting, loading_scene, answering };
  struct Verdict {
    Outcome outcome;
    std::string why;
    bool blocked = false;  // it used no CPU: a retry would cost the same wall time again
  };

  explicit Watchdog(const WorkerLimits& limits) : limits_(limits) {}
  void progress(const WorkerProcess& w);
  /// The cost of a query that got no answer, including the end of its process.
  std::int64_t since_progress_ns() const { return (Clock::now() - progress_at_).count(); }
  /// Whether a query that took `elapsed_ns` of wall time exceeded its CPU time.
  bool was_slow(const WorkerProcess& w, std::int64_t elapsed_ns) const;
  /// True once per tick.
  bool is_due() const { return Clock::now() - last_check_ >= tick; }
  /// The reason to kill the worker, if there is one.
  std::optional<Verdict> check(const WorkerProcess& w, Phase phase);

  static constexpr auto tick = std::chrono::milliseconds(10);

 private:
  std::optional<Verdict> over_memory(const WorkerProcess& w);
  std::optional<Verdict> over_cpu(const WorkerProcess& w, Phase phase) const;
  std::optional<Verdict> over_wall_time(Phase phase) const;
  void look_at_all(const WorkerProcess& w, Clock::duration since_last);

  const WorkerLimits& limits_;
  double cpu_at_progress_ = 0;
  double cpu_of_all_ = 0, cpu_of_all_at_progress_ = 0, precise_at_look_ = 0;
  bool progressed_ = true;
  std::uint64_t resident_of_all_ = 0;
  char state_ = '?';
  Clock::duration idle_{}, blocked_{};
  Clock::time_point last_check_ = Clock::now(), progress_at_ = last_check_, last_look_ = last_check_;
};

}  // namespace touchstone
