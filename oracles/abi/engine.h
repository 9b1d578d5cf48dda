// An engine as the harness sees it: a card, and batches of cases in, observations out.
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
  /// One CaseObservations a case, one Observation a query, always: whatever the engine does, the result is
  /// complete. Throws Stopped (worker_limits.h) when whoever made it wants all engines to stop.
  virtual std::vector<CaseObservations> run(std::span<const Case> cases) = 0;
  /// The same cases asked again, in memory that held something else before: an answer that differs was made
  /// of memory that nobody wrote, or of what was asked before. Empty: this engine cannot be asked so.
  virtual std::vector<CaseObservations> run_again(std::span<const Case>) { return {}; }
  /// Why it is asked nothing any more, its answers being `not_asked`; empty while it is asked.
  virtual std::string set_aside() const { return ""; }
  /// From now on it is asked again, with all patience; or not, for this reason.
  virtual void take_back() {}
  virtual void put_aside(const std::string& /*why*/) {}
};

using EnginePtr = std::unique_ptr<Engine>;

}  // namespace touchstone
