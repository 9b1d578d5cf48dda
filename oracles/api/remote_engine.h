// An engine in a worker process. Whatever the engine does — crash, hang, print, eat memory — every query gets
// an observation: the running one is charged, the worker is restarted, and the rest is asked of the new one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "oracles/api/engine.h"

namespace touchstone {

/// CPU time is what the watchdog goes by, so that a loaded machine does not turn answers into time-outs; wall
/// time only catches an engine that sleeps.
struct WorkerLimits {
  double query_cpu_seconds = 1;
  double load_cpu_seconds = 10;  // taking a scene: hierarchies of large meshes are built here
  double wall_seconds = 20;      // without any progress
  double start_wall_seconds = 60;
  std::uint64_t resident_bytes = std::uint64_t{2} << 30;
};

struct RemoteSpec {
  std::filesystem::path host;    // the program touchstone-host
  std::filesystem::path plugin;  // shared object with touchstone_plugin_v1, or pipe:COMMAND
  std::string engine;            // name on its card; empty: the only one that the plug-in offers
  WorkerLimits limits;
};

class RemoteEngine final : public Engine {
 public:
  /// Starts a first worker. Throws InputError when the plug-in is absent, cannot be loaded, speaks another
  /// version of the ABI, or does not offer the engine.
  explicit RemoteEngine(RemoteSpec spec);
  ~RemoteEngine() override;
  const EngineCard& card() const override;
  std::vector<CaseObservations> run(std::span<const Case> cases) override;

  /// How often a worker had to be replaced so far.
  int restarts() const;
  /// Process id of the current worker, or -1. For tests that kill it.
  int worker_pid() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The cards of all engines of a plug-in, as its worker reports them; the harness itself never loads it.
std::vector<EngineCard> list_plugin_engines(const std::filesystem::path& host,
                                            const std::filesystem::path& plugin);

}  // namespace touchstone
