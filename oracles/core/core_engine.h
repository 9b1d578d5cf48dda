// The project's own core behind the engine interface, in process.
#pragma once

#include "oracles/api/engine.h"

namespace touchstone {

class CoreEngine final : public Engine {
 public:
  CoreEngine();
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override;

 private:
  EngineCard card_;
};

EnginePtr make_core_engine();

}  // namespace touchstone
