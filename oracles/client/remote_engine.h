// An engine in a worker process. Whatever the engine does — crash, hang, print, eat memory — every query gets
// an observation: the running one is charged, the worker is restarted, and the rest is asked of the new one.
// An engine that times out again and again (patience.h) is set aside: what is left is `not_asked`.
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
  std::string engine;            // name on its card; empty: the only one that the plug-in offers
  WorkerLimits limits;
  /// Of an engine of this build (native_engine.h): its card. No worker is started before the first question,
  /// and answers come in batches.
  std::optional<EngineCard> native = std::nullopt;
};

class RemoteEngine final : public Engine {
 public:
  /// Starts a first worker, but of a native engine. Throws InputError when the plug-in is absent, cannot be
  /// loaded, speaks another version of the ABI, or does not offer the engine.
  explicit RemoteEngine(RemoteSpec spec);
  ~RemoteEngine() override;
  const EngineCard& card() const override;
  std::vector<CaseObservations> run(std::span<const Case> cases) override;
  std::vector<CaseObservations> run_again(std::span<const Case> cases) override;
  std::string set_aside() const override;
  void take_back() override;
  void put_aside(const std::string& why) override;

  /// What the worker is kept from, in words; "none" without a sandbox, empty before a worker is started.
  std::string sandbox() const;
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
