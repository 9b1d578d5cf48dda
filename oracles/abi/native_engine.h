// An engine of this build that its worker asks in C++ and not through the C ABI: it takes a scene as the
// harness sends it, with the hulls that were made once, and its answers lose nothing on their way.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "oracles/abi/engine.h"

namespace touchstone {

class NativeEngine : public Engine {
 public:
  using Tell = std::function<void(Observation)>;
  /// What it holds of the scene. All is received as it was sent unless overridden.
  virtual ReceivedScene received(const Scene& scene) const {
    ReceivedScene r;
    r.bodies.resize(scene.bodies.size());
    r.shapes.resize(scene.shapes.size());
    return r;
  }
  /// Answers the queries of the case in their order, and tells each answer as soon as it is there.
  virtual void answer(const Case& c, const Tell& tell) = 0;

  std::vector<CaseObservations> run(std::span<const Case> cases) final {
    std::vector<CaseObservations> all;
    all.reserve(cases.size());
    for (const Case& c : cases) {
      CaseObservations& r = all.emplace_back();
      r.received = received(c.scene);
      answer(c, [&r](Observation o) { r.answers.push_back(std::move(o)); });
    }
    return all;
  }
};

/// What a library of native engines exports under this name, with C linkage: makes the engine so called; null
/// when there is none. Library and host are of one build.
using MakeNativeEngine = NativeEngine*(const char* name);
inline constexpr const char* make_native_engine_symbol = "touchstone_native_engine";

}  // namespace touchstone
