// An engine in a worker process. Whatever the engine does (crash, hang, print, exhaust memory), every query
// gets an observation: the running query is charged, the worker is restarted, and the new one answers the
// rest. An engine that times out repeatedly (patience.h) is set aside: its remaining queries are `not_asked`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "oracles/abi/engine.h"
#include "oracles/client/worker_limits.h"

namespace touchstone {

struct RemoteSpec {
  std::filesystem::path host;    // the program touchstone-host
  std::filesystem::path plugin;  // shared object with touchstone_plugin_v1, or pipe:COMMAND
  std::string engine;            // name on its card; empty: the plug-in's only engine
  WorkerLimits limits;
  /// For an engine of this build (native_engine.h): its card. No worker is started before the first question,
  /// and answers arrive in batches.
  std::optional<EngineCard> native = std::nullopt;
  /// What its card shall say instead, if not empty: for a library that is present in several builds.
  std::string shown_name = {}, shown_version = {};
};

class RemoteEngine final : public Engine {
 public:
  /// Starts the first worker, except for a native engine. Throws InputError if the plug-in does not exist,
  /// cannot be loaded, uses a different ABI version, or does not offer the engine.
  explicit RemoteEngine(RemoteSpec spec);
  ~RemoteEngine() override;
  const EngineCard& card() const override;
  std::vector<CaseObservations> run(std::span<const Case> cases) override;
  std::vector<CaseObservations> run_again(std::span<const Case> cases) override;
  std::string set_aside() const override;
  void resume() override;
  void suspend(const std::string& why) override;

  /// Describes the worker's sandbox; "none" without one, empty before a worker is started.
  std::string sandbox() const;
  /// How often a worker had to be replaced so far.
  int restarts() const;
  /// Process id of the current worker, or -1. For tests that kill it.
  int worker_pid() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The cards of all engines of a plug-in, as its worker reports them; the harness itself never loads a
/// plug-in.
std::vector<EngineCard> list_plugin_engines(const std::filesystem::path& host,
                                            const std::filesystem::path& plugin);

}  // namespace touchstone
