#include "oracles/client/watchdog.h"

#include <algorithm>

namespace touchstone {
namespace {

// All descendants of the worker are examined, which is slower than examining the worker alone.
constexpr auto look_every = std::chrono::milliseconds(50);
// CPU time that a command may use per second allowed to a plug-in: it parses and prints lines, often in an
// interpreter.
constexpr double cpu_of_children = 5;
constexpr double least_cpu_use = 1e-3;  // CPU seconds between two examinations; less counts as waiting

double seconds(Watchdog::Clock::duration d) { return std::chrono::duration<double>(d).count(); }

const char* while_what(Watchdog::Phase phase) {
  if (phase == Watchdog::Phase::starting) return " while starting";
  return phase == Watchdog::Phase::loading_scene ? " while loading the scene" : "";
}

ProcessUsage usage_of_all(const WorkerProcess& w) {
  const pid_t parent = w.parent_pid();
  return parent > 0 ? usage_of_tree(parent, /*with_root=*/false) : usage_of_tree(w.pid(), /*with_root=*/true);
}

}  // namespace

void Watchdog::progress(const WorkerProcess& w) {
  cpu_at_progress_ = w.cpu_seconds();
  progress_at_ = Clock::now();
  progressed_ = true;
  idle_ = blocked_ = {};
  resident_of_all_ = 0;  // it may be that of the previous worker
}

bool Watchdog::was_slow(const WorkerProcess& w, std::int64_t elapsed_ns) const {
  return seconds_per_ns * static_cast<double>(elapsed_ns) > limits_.query_cpu_seconds &&
         w.cpu_seconds() - cpu_at_progress_ > limits_.query_cpu_seconds;
}

std::optional<Watchdog::Verdict> Watchdog::check(const WorkerProcess& w, Phase phase) {
  const auto now = Clock::now();
  // The harness itself may have been stopped or starved: a gap in its own ticks is not charged to the worker.
  const auto gap = std::min<Clock::duration>(now - last_check_, 5 * tick);
  last_check_ = now;
  if (state_ != 't') idle_ += gap;  // a debugger holds it
  if (now - last_look_ >= look_every) look_at_all(w, now - last_look_);
  if (auto v = over_memory(w)) return v;
  if (auto v = over_cpu(w, phase)) return v;
  return over_wall_time(phase);
}

void Watchdog::look_at_all(const WorkerProcess& w, Clock::duration since_last) {
  last_look_ = Clock::now();
  const ProcessUsage all = usage_of_all(w);
  // The worker's precise clock is added once more, to see usage below 10 ms.
  const double precise = all.cpu_seconds + w.cpu_seconds();
  const bool waits = precise - precise_at_look_ < least_cpu_use && (all.state == 'S' || all.state == 'T');
  blocked_ = waits ? blocked_ + std::min<Clock::duration>(since_last, 2 * look_every) : Clock::duration{};
  precise_at_look_ = precise;
  cpu_of_all_ = all.cpu_seconds;
  resident_of_all_ = all.resident_bytes;
  state_ = all.state;
  if (progressed_) cpu_of_all_at_progress_ = cpu_of_all_;
  progressed_ = false;
}

std::optional<Watchdog::Verdict> Watchdog::over_memory(const WorkerProcess& w) {
  const std::uint64_t resident = std::max(usage_of(w.pid()).resident_bytes, resident_of_all_);
  if (resident <= limits_.resident_bytes) return std::nullopt;
  return Verdict{Outcome::crashed, "memory limit"};
}

std::optional<Watchdog::Verdict> Watchdog::over_cpu(const WorkerProcess& w, Phase phase) const {
  const bool starting = phase == Phase::starting;
  const double used = starting ? cpu_of_all_ - cpu_of_all_at_progress_ : w.cpu_seconds() - cpu_at_progress_;
  const double most = starting                        ? limits_.start_cpu_seconds
                      : phase == Phase::loading_scene ? limits_.load_cpu_seconds
                                                      : limits_.patience * limits_.query_cpu_seconds;
  if (used > most) return Verdict{Outcome::timed_out, std::string("CPU time") + while_what(phase)};
  if (starting || cpu_of_all_ - cpu_of_all_at_progress_ <= cpu_of_children * most) return std::nullopt;
  return Verdict{Outcome::timed_out, std::string("CPU time of its children") + while_what(phase)};
}

std::optional<Watchdog::Verdict> Watchdog::over_wall_time(Phase phase) const {
  const double most = phase == Phase::starting ? limits_.start_wall_seconds : limits_.wall_seconds;
  if (seconds(idle_) > most) return Verdict{Outcome::timed_out, std::string("wall time") + while_what(phase)};
  if (seconds(blocked_) <= limits_.blocked_seconds) return std::nullopt;
  const std::string how = state_ == 'T' ? "stopped by a signal" : "waits and uses no CPU: wall time";
  return Verdict{Outcome::timed_out, how + while_what(phase), true};
}

}  // namespace touchstone
