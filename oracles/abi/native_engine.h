// An engine of this build that its worker calls in C++ rather than through the C ABI: it takes the scene as
// the harness sends it, with hulls already built, and its answers are passed on without conversion.
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
  /// The scene as the engine holds it. By default everything is received as it was sent.
  virtual ReceivedScene received(const Scene& scene) const {
    ReceivedScene r;
    r.bodies.resize(scene.bodies.size());
    r.shapes.resize(scene.shapes.size());
    return r;
  }
  /// Answers the queries of the case in order, and passes on each answer as soon as it is available.
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

/// The factory that a library of native engines exports under the name below, with C linkage: creates the
/// engine of that name, or returns null. Library and host come from the same sources (source_id.h).
using MakeNativeEngine = NativeEngine*(const char* name);
inline constexpr const char* make_native_engine_symbol = "touchstone_native_engine";

}  // namespace touchstone
