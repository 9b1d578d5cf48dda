// The project's own core behind the engine interface: `core`, and `core-f32`, its narrow phase entirely in
// float. Created here it runs in-process, for tests; the program runs it in a worker.
#pragma once

#include "core/narrow/narrow_phase.h"
#include "oracles/abi/native_engine.h"

namespace touchstone {

class CoreEngine final : public NativeEngine {
 public:
  explicit CoreEngine(Arithmetic arithmetic = Arithmetic::float64);
  const EngineCard& card() const override { return card_; }
  ReceivedScene received(const Scene& scene) const override;
  void answer(const Case& c, const Tell& tell) override;

 private:
  Arithmetic arithmetic_;
  EngineCard card_;
};

EnginePtr make_core_engine();

}  // namespace touchstone
