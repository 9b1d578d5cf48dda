// An engine as the harness sees it: it has a card, takes batches of cases and returns observations.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scenarios/value/engine_card.h"
#include "scenarios/value/observation.h"

namespace touchstone {

class Engine {
 public:
  virtual ~Engine() = default;
  virtual const EngineCard& card() const = 0;
  /// Returns one CaseObservations per case and one Observation per query: whatever the engine does, the
  /// result is complete. Throws Stopped (worker_limits.h) when all engines have been told to stop.
  virtual std::vector<CaseObservations> run(std::span<const Case> cases) = 0;
  /// Runs the same cases again, in memory with different previous content: an answer that differs depends on
  /// uninitialised memory or on earlier queries. Empty: this engine does not support it.
  virtual std::vector<CaseObservations> run_again(std::span<const Case>) { return {}; }
  /// Why the engine is no longer queried, so that its answers are `not_asked`; empty while it is queried.
  virtual std::string set_aside() const { return ""; }
  /// Resumes querying, in a new process if it was put aside, with the patience counters reset.
  virtual void take_back() {}
  /// Stops querying, for this reason.
  virtual void put_aside(const std::string& /*why*/) {}
};

using EnginePtr = std::unique_ptr<Engine>;

}  // namespace touchstone
