// Cases for the misbehaving plug-ins, and paths.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "oracles/client/remote_engine.h"

namespace touchstone::testing {

inline std::filesystem::path host_path() {
  return std::filesystem::path(TS_BINARY_DIR) / "bin/touchstone-host";
}
inline std::filesystem::path plugin_path(const std::string& target) {
  return std::filesystem::path(TS_BINARY_DIR) / ("lib/lib" + target + ".so");
}

/// Limits that keep the tests short; the queries that they stop never end. The wall time limit is short only
/// for engines that sleep: on a loaded machine it would expire before the others have used their CPU time.
inline WorkerLimits short_limits(bool sleeper = false) {
  WorkerLimits l;
  l.query_cpu_seconds = 0.3;
  l.patience = 1;
  l.load_cpu_seconds = 0.3;
  l.wall_seconds = sleeper ? 2 : 600;
  l.blocked_seconds = sleeper ? 0.5 : 600;
  l.resident_bytes = std::uint64_t{512} << 20;
  return l;
}

inline RemoteSpec bad_spec(const std::string& engine) {
  const bool sleeper = engine == "sleeps" || engine == "announces";
  WorkerLimits limits = short_limits(sleeper);
  // The first access to a page is slow on some virtual machines; the memory limit must be hit, not the time
  // limit.
  if (engine == "eats_memory") limits.query_cpu_seconds = 60;
  return {host_path(), plugin_path("ts_bad_behaviours"), engine, limits};
}

/// Three spheres, all pairs queried; in a triggered case the pair (0, 2) misbehaves.
inline Case make_case(int index, bool triggered) {
  Case c;
  c.id = "bad/" + std::to_string(index);
  c.scene.shapes = {Sphere{1}};
  for (int i = 0; i < 3; ++i) {
    Body b;
    b.pose.translation = Vec3(triggered && i == 0 ? 666 : i, index, 0);
    c.scene.bodies.push_back(b);
  }
  c.queries = {{Question::overlap, 0, 1}, {Question::overlap, 0, 2}, {Question::distance, 1, 2}};
  return c;
}

inline std::vector<Case> make_cases(int n, int triggered) {
  std::vector<Case> cases;
  for (int i = 0; i < n; ++i) cases.push_back(make_case(i, i == triggered));
  return cases;
}

/// True if the answer is that of a well-behaved query of case `index`.
inline bool is_good(const Observation& o, int index, const Query& q) {
  return o.outcome == Outcome::answered && o.overlap == ((q.a + q.b) % 2 != 0) &&
         o.distance == q.a + 10 * q.b + index;
}

}  // namespace touchstone::testing
