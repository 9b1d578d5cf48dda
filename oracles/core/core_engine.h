// The project's own core behind the engine interface, in process: `core`, and `core-f32`, its narrow phase in
// float from end to end.
#pragma once

#include "core/narrow/narrow_phase.h"
#include "oracles/api/engine.h"

namespace touchstone {

class CoreEngine final : public Engine {
 public:
  explicit CoreEngine(Arithmetic arithmetic = Arithmetic::float64);
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override;

 private:
  Arithmetic arithmetic_;
  EngineCard card_;
};

EnginePtr make_core_engine();

}  // namespace touchstone
